// Single steps to solve: grains apart from each other that are on their way into each other.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/dynamics/solve.hpp"
#include "engine/scene/start.hpp"
#include "tests/support/draw.hpp"
#include "tests/support/instruction_sets.hpp"
#include "tests/support/named_contacts.hpp"
#include "tests/support/scenes.hpp"

namespace grainsweep::testing {

/// Grains apart from each other, and free motions that would drive them into each other.
template <class Real>
struct StepProblem {
  SphereBed bed;
  SphereContacts<Real> contacts;
  MotionColumns<Real> motion;
};

template <class Real>
std::vector<Record<Real>> colliding_motion(const SphereBed& bed, Draw& draw) {
  std::vector<Record<Real>> motion;
  for (std::size_t i = 0; i < bed.motion.size(); ++i) {
    const double size = i < bed.grains() ? 0.3 : 0.0;
    const double x = draw.uniform(-size, size), y = draw.uniform(-size, size);
    motion.push_back({static_cast<Real>(x), static_cast<Real>(y),
                      static_cast<Real>(draw.uniform(-2 * size, 0.0)),
                      static_cast<Real>(bed.motion[i].w)});
  }
  return motion;
}

template <class Real>
StepProblem<Real> random_problem_in(const Box& box, std::int64_t grains, std::uint64_t seed,
                                    Draw& draw) {
  PackingSpec spec;
  spec.box = box;
  spec.fill = GrainCount{grains};
  spec.sizes = {0.05, 0.2, 0.6};
  spec.random_key = seed;
  StepProblem<Real> problem{start<Sphere>(spec).value(), {}, {}};
  problem.contacts = testing::contacts_of<Real>(problem.bed, 0.4, kernels());
  problem.motion.free = colliding_motion<Real>(problem.bed, draw);
  return problem;
}
template <class Real>
StepProblem<Real> random_problem(std::int64_t grains, std::uint64_t seed) {
  Draw draw(seed);
  const Boundary along_x = draw.chance(0.5) ? periodic : walls;
  return random_problem_in<Real>({2.6, 2.6, along_x, walls}, grains, seed, draw);
}

}  // namespace grainsweep::testing
