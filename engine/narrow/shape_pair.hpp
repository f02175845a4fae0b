// Two grains of convex shapes, as narrow phase looks at them.
//
// All of narrow phase works in the shape frame of grain a, about the centre of a, in d. Normals
// point from a to b: an impulse p pushes b by +p normal and a by -p normal.
#pragma once

#include "engine/shape/pose.hpp"

namespace grainsweep {

/// One grain of a pair as the other sees it: in the frame of the other, about its centre, a point x
/// of the shape lies at centre + turn x.
struct SeenShape {
  const ConvexShape& shape;
  Vector centre;  ///< d
  Matrix turn;    ///< and scale

  Vector place(std::int32_t vertex) const {
    return centre + turn * shape.vertices[static_cast<std::size_t>(vertex)];
  }
};

struct ShapePair {
  const ConvexShape& a;
  const ConvexShape& b;
  PairPose pose;

  /// Distance of the centres at which the balls around the two touch, d.
  double size() const { return pose.scale_a * a.circumradius + pose.scale_b * b.circumradius; }
  /// A vertex of either grain, in the frame of a.
  Vector vertex_a(std::int32_t k) const {
    return pose.scale_a * a.vertices[static_cast<std::size_t>(k)];
  }
  Vector vertex_b(std::int32_t k) const {
    return pose.centre + pose.scale_b * (pose.turn * b.vertices[static_cast<std::size_t>(k)]);
  }

  SeenShape b_from_a() const { return {b, pose.centre, pose.scale_b * pose.turn}; }
  SeenShape a_from_b() const {
    const Matrix back = pose.turn.transpose();
    return {a, -(back * pose.centre), pose.scale_a * back};
  }
};

}  // namespace grainsweep
