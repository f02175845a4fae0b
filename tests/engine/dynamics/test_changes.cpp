#include <cmath>
#include <vector>

#include <catch2/catch.hpp>

#include "engine/dynamics/changes.hpp"
#include "engine/dynamics/step.hpp"
#include "tests/support/about.hpp"
#include "tests/support/bits.hpp"
#include "tests/support/part_loops.hpp"
#include "tests/support/step_problems.hpp"

namespace grainsweep {
namespace {

using testing::Draw;
using testing::kernels;
using testing::periodic;
using testing::StepProblem;
using testing::walls;

// The motion of a step is unique, the impulses of these few grains, too.
TEST_CASE("changes of impulses add up to what is found from the impulses themselves") {
  constexpr double tolerance = 1e-13, margin = 1e-10;  // tolerance times conditioning
  for (const Box& box :
       {Box{2.6, 2.6, walls, walls}, Box{2.6, 2.6, periodic, periodic}, tube_of(2.6)}) {
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
      INFO("tube " << box.is_tube << ", periodic " << (box.x == periodic) << ", seed " << seed);
      Draw draw(seed);
      StepProblem<double> whole = testing::random_problem_in<double>(box, 16, seed, draw);
      const SolveLimits limits{Solver::accelerated_gauss_seidel, 20'000, tolerance};
      solve(limits, kernels(), whole.contacts, whole.motion);
      whole.motion.free = testing::colliding_motion<double>(whole.bed, draw);
      StepProblem<double> changes = whole;
      const SolveReport expected = solve(limits, kernels(), whole.contacts, whole.motion);
      const SolveReport report = solve_changes(limits, kernels(), changes.contacts, changes.motion);
      CHECK(expected.residual <= tolerance);
      CHECK(report.residual <= tolerance);
      CHECK(report.loaded == expected.loaded);
      for (std::size_t i = 0; i < whole.motion.u.size(); ++i) {
        const Record<double>&u = changes.motion.u[i], &right = whole.motion.u[i];
        REQUIRE(u.x == about(right.x, margin));
        REQUIRE(u.y == about(right.y, margin));
        REQUIRE(u.z == about(right.z, margin));
        REQUIRE(u.w == right.w);
      }
      CHECK(testing::same_bits(changes.motion.free, whole.motion.free));
      for (const double p : changes.contacts.impulse) {
        if (!box.is_tube) REQUIRE(p >= 0.0);
      }
      CHECK(changes.contacts.changed_from.empty());
    }
  }
}

/// A column of touching spheres, each contact with the weight above it and a share of it more.
template <class Real>
StepProblem<Real> column_at_rest(int grains, double share) {
  StepProblem<Real> problem{testing::column_bed(grains, 0.0), {}, {}};
  problem.contacts = testing::contacts_of<Real>(problem.bed, 1e-3, kernels());
  for (RowBlock<Real>& row : problem.contacts.rows) {  // touching but for rounding
    for (Real& gap : row.gap) gap = std::abs(gap) < Real(1e-3) ? Real(0) : gap;
  }
  const double weight = 0.01;  // m g dt^2
  for (const Record<double>& m : problem.bed.motion) {
    const double fall = m.w > 0.0 && problem.motion.free.size() < problem.bed.grains() ? weight : 0;
    problem.motion.free.push_back(
        {Real(0), Real(0), static_cast<Real>(-fall), static_cast<Real>(m.w)});
  }
  for (std::size_t at = 0; at < problem.contacts.impulse.size(); ++at) {
    const RowBlock<Real>& row = problem.contacts.rows[at / block_width];
    const std::size_t lane = at % block_width;
    if (problem.bed.is_void(row.a(lane)) || row.gap[lane] != Real(0)) continue;
    const double z = problem.bed.position[static_cast<std::size_t>(row.a(lane))].z;
    const bool is_pair = at / block_width < problem.contacts.pair_blocks;
    const double high =
        is_pair ? std::max(z, problem.bed.position[static_cast<std::size_t>(row.b(lane))].z) : z;
    problem.contacts.impulse[at] =
        static_cast<Real>((1.0 + share * std::sin(high)) * weight * (grains - std::floor(high)));
  }
  return problem;
}

TEST_CASE("f32 knows the small changes of large impulses nearly as well as f64") {
  constexpr int grains = 300;
  const SolveLimits limits{Solver::accelerated_gauss_seidel, 4000, 0.0};
  auto plain = column_at_rest<float>(grains, 1e-3), changes = plain;
  const double rounded = solve(limits, kernels(), plain.contacts, plain.motion).residual;
  const double left = solve_changes(limits, kernels(), changes.contacts, changes.motion).residual;
  // Impulses of 300 weights of 0.01 are known to 2e-7, their changes of a thousandth to 2e-10;
  // momentum multiplies either.
  CHECK(rounded > 2e-7);
  CHECK(left < rounded / 30.0);
}

TEST_CASE("steps of a high bed of several subdomains have the same bits in any order of parts") {
  std::vector<PlacedSphere> grains;
  Draw draw(3);
  constexpr int side = 13, layers = 102;
  for (int k = 0; k < layers; ++k) {
    for (int i = 0; i < side * side; ++i) {
      const double x = 0.5 + i % side, y = 0.5 + i / side;
      grains.push_back({x + draw.uniform(-0.01, 0.01), y + draw.uniform(-0.01, 0.01),
                        0.5 + k + draw.uniform(-0.01, 0.01), 0.5});
    }
  }
  const Box box{side, side, periodic, walls};
  REQUIRE(grains.size() >= large_bed_grains<Sphere>);
  StepSettings settings;
  settings.carries = true;
  settings.limits.iterations = 20;
  std::vector<Record<double>> expected;
  for (const ParallelFor& loop : {ParallelFor(serial_for), ParallelFor(testing::last_part_first),
                                  ParallelFor(testing::two_threads)}) {
    SphereBed bed = make_bed(box, grains);
    REQUIRE(is_high(bed));
    REQUIRE(bed.subdomains > 2);
    StepState<Sphere, float> state;
    for (int k = 0; k < 3; ++k) step(settings, {kernels(), loop}, bed, state);
    const std::vector<Record<double>> places(bed.centres().begin(), bed.centres().end());
    if (expected.empty()) expected = places;
    CHECK(testing::same_bits(places, expected));
  }
}

}  // namespace
}  // namespace grainsweep
