// Pairs in which one grain or both are spheres: the point of a polyhedron that is nearest to a
// sphere's centre.
//
// A sphere touches at one point, whose normal passes through its centre. The nearest point is
// looked for on every face that the centre lies above and on every edge, in closed form: there is
// nothing that could stop early.
#pragma once

#include "engine/narrow/separating_axes.hpp"
#include "engine/narrow/shape_pair.hpp"

namespace grainsweep {

/// The point of a polyhedron's surface that is nearest to a given one.
struct NearestPoint {
  Vector point = Vector::Zero();    ///< in the frame of the shape, scaled, d
  Vector outward = Vector::Zero();  ///< unit, from it to the given one, the other way if that lies
                                    ///< within
  double distance = 0.0;            ///< d; negative = the given one lies within
  AxisKind kind = AxisKind::ball_on_face;  ///< what it lies on
};

/// For a polyhedron of this scale. For a point within it, the nearest point on a face's plane.
NearestPoint nearest_point(const ConvexShape& shape, double scale, const Vector& of);

/// The only point of contact of a pair.
struct BallContact {
  Vector normal = Vector::Zero();    ///< unit, from a to b, frame of a
  Vector position = Vector::Zero();  ///< midway between the surfaces, frame of a, d
  double gap = 0.0;                  ///< true distance, d; negative = overlap
  AxisKind kind = AxisKind::round;
};

/// Whether one of them or both are spheres.
inline bool has_ball(const ShapePair& pair) { return pair.a.is_ball || pair.b.is_ball; }

/// Requires that one of them is a sphere.
BallContact ball_contact(const ShapePair& pair);

}  // namespace grainsweep
