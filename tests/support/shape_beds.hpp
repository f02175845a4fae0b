// Beds of polyhedra, and their balance, measured without rows and levers.
#pragma once

#include <vector>

#include "engine/dynamics/step.hpp"
#include "engine/narrow/constraints.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/shapes.hpp"

namespace grainsweep::testing {

inline Pose pose_at(double x, double y, double z,
                    const Quaternion& orientation = Quaternion::Identity(), double scale = 1) {
  return {{x, y, z}, scale, orientation};
}

/// Grains of one shape.
inline PolyhedronBed shape_bed(const Box& box, const ConvexShape& shape,
                               const std::vector<Pose>& poses) {
  return make_bed(box, {shape}, {}, poses);
}

/// Grains turned at random with centres at random in a box, up to `height`.
inline PolyhedronBed random_shape_bed(const Box& box, const ConvexShape& shape, std::size_t grains,
                                      double height, std::uint64_t seed) {
  Draw draw(seed);
  std::vector<Pose> poses;
  for (std::size_t i = 0; i < grains; ++i) {
    const double x = draw.uniform(0, box.length), y = draw.uniform(0, box.width);
    const double z = draw.uniform(0.3, height);
    const Quaternion turn = random_rotation(draw);
    poses.push_back(pose_at(x, y, z, turn, draw.uniform(0.9, 1.1)));
  }
  return shape_bed(box, shape, poses);
}

/// The contacts of a bed so small that it is one subdomain.
template <class Real>
const ContactPart<Real>& part_of(const PolyhedronContacts<Real>& contacts) {
  return contacts.parts.front();
}
template <class Real>
const ContactList& list_of(const StepState<Polyhedron, Real>& state) {
  return part_of(state.contacts).found;
}
/// Impulse of point j of contact k of such a bed, in masses times d.
template <class Real>
double impulse_of(const StepState<Polyhedron, Real>& state, std::size_t k, std::size_t j) {
  return grainsweep::impulse_of(state.contacts, part_of(state.contacts), k, j);
}

/// Force and torque about its centre on a grain, box frame.
struct Wrench {
  Vector force = Vector::Zero(), torque = Vector::Zero();
};

/// What the contacts of a step do to each grain, m g and m g d, from points of contact and normals
/// in the box. `before`: the bed as the step found it.
template <class Real>
std::vector<Wrench> wrenches(const PolyhedronBed& before, const StepState<Polyhedron, Real>& state,
                             double dt) {
  std::vector<Wrench> sums(before.grains());
  for (std::size_t k = 0; k < list_of(state).contacts.size(); ++k) {
    const PolyhedronContact& c = list_of(state).contacts[k];
    const auto a = static_cast<std::size_t>(c.a), b = static_cast<std::size_t>(c.b);
    const Quaternion turn = before.pose(a).orientation;
    for (std::size_t j = 0; j < c.count; ++j) {
      const Vector force = impulse_of(state, k, j) / (dt * dt) * (turn * c.normal);
      const Vector from_a = turn * list_of(state).points[c.first + j].position;
      sums[a].force -= force;
      sums[a].torque -= from_a.cross(force);
      if (before.is_grain(c.b)) {
        sums[b].force += force;
        sums[b].torque += (from_a - nearest_difference(before, a, b)).cross(force);
      }
    }
  }
  return sums;
}

/// Force of all points of contact k together, m g.
template <class Real>
double contact_force(const StepState<Polyhedron, Real>& state, std::size_t k, double dt) {
  double sum = 0;
  for (std::size_t j = 0; j < list_of(state).contacts[k].count; ++j) {
    sum += impulse_of(state, k, j) / (dt * dt);
  }
  return sum;
}

/// Sum of the forces between grains and one entry of the bed that is a wall, m g.
template <class Real>
double wall_force(const StepState<Polyhedron, Real>& state, std::int32_t wall, double dt) {
  double sum = 0;
  for (std::size_t k = 0; k < list_of(state).contacts.size(); ++k) {
    if (list_of(state).contacts[k].b == wall) sum += contact_force(state, k, dt);
  }
  return sum;
}

inline double weight_of(const PolyhedronBed& bed) {
  double weight = 0;
  for (std::size_t i = 0; i < bed.grains(); ++i) weight += 1 / bed.motion[i].w;
  return weight;
}

}  // namespace grainsweep::testing
