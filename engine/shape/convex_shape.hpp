// A convex polyhedron in its own frame: what all grains of one shape share.
//
// The frame has its origin at the centroid and its axes along the principal axes of inertia. A
// grain is the shape scaled, turned and moved by its pose (engine/shape/pose.hpp); at scale 1
// lengths are in d. Everything that narrow phase, measures and dynamics ask of a shape is worked
// out once, here.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "engine/shape/vector_columns.hpp"
#include "kernels/kernels.hpp"

namespace grainsweep {

using Vector = Eigen::Vector3d;
using Matrix = Eigen::Matrix3d;

/// Faces whose normals differ by less than this angle, radians, touch as if they were one.
inline constexpr double nearly_flat = 0.03;

/// A flat face; the shape lies where normal . x <= offset.
struct Face {
  Vector normal = Vector::Zero();  ///< unit, outward
  double offset = 0.0;             ///< distance of its plane from the centroid, d
  std::int32_t first = 0;          ///< its corners are loops[first] .. loops[first + corners - 1],
  std::int32_t corners = 0;        ///< counter-clockwise seen from outside
};

/// A side of a face, upright on it: the face lies where outward . x <= offset.
struct Side {
  Vector outward = Vector::Zero();  ///< unit, in the plane of the face
  double offset = 0.0;              ///< d
};

/// An edge from one vertex to another. Seen from outside with `to` above `from`, face `left` is on
/// the left.
struct Edge {
  std::int32_t from = 0, to = 0;     ///< vertices
  std::int32_t left = 0, right = 0;  ///< faces
  std::int32_t direction = 0;        ///< in `edge_directions`, up to sign
  Vector along = Vector::Zero();     ///< unit, towards `to`
};

/// Where a shape in its frame came from: x_given = rotation x_shape + centroid.
struct InputFrame {
  Vector centroid = Vector::Zero();
  Matrix rotation = Matrix::Identity();
};

/// A grain of scale w has the volume w^3 volume, moments over its mass of w^2 inertia, and w times
/// the radii. A sphere among polyhedra is a ConvexShape, too: it has one vertex, its centre, and no
/// faces.
struct ConvexShape {
  std::vector<Vector> vertices;
  std::vector<Face> faces;
  VectorColumns corner_columns;        ///< the vertices
  VectorColumns normal_columns;        ///< those of the faces
  std::vector<double> offset_columns;  ///< of the faces, padded alike
  std::vector<std::int32_t> loops;     ///< vertices of the faces, face after face
  std::vector<Side> sides;  ///< of the faces: a side begins at the corner in the same place of
                            ///< `loops`
  std::vector<Edge> edges;
  std::vector<Vector> edge_directions;           ///< unit, distinct up to sign
  std::vector<std::int32_t> vertex_faces;        ///< faces at each vertex, vertex after vertex
  std::vector<std::int32_t> vertex_faces_begin;  ///< where those of each vertex begin; one more at
                                                 ///< the end
  /// The other faces whose normals differ from each face's by less than nearly_flat, face after
  /// face: it touches together with them.
  std::vector<std::int32_t> flat_with;
  std::vector<std::int32_t> flat_with_begin;  ///< where those of each face begin; one more at the
                                              ///< end
  double volume = 0.0;                        ///< d^3
  Vector inertia = Vector::Zero();            ///< principal moments over mass, d^2
  double circumradius = 0.0;                  ///< of the smallest ball around the centroid, d
  double inradius = 0.0;                      ///< of the largest ball around the centroid within, d
  std::optional<PinacoidHalves> pinacoid;     ///< if the shape is one
  bool is_ball = false;                       ///< a sphere; both radii are its own
  InputFrame given;                           ///< the frame in which its vertices were written

  /// Volume of a grain of that scale, d^3.
  double volume_at(double scale) const { return scale * scale * scale * volume; }
};

/// Vertices of a face, counter-clockwise seen from outside.
inline std::span<const std::int32_t> corners_of(const ConvexShape& shape, const Face& face) {
  return {shape.loops.data() + face.first, static_cast<std::size_t>(face.corners)};
}

/// See ConvexShape::flat_with.
inline std::span<const std::int32_t> flat_with(const ConvexShape& shape, std::size_t face) {
  const auto begin = static_cast<std::size_t>(shape.flat_with_begin[face]);
  return {shape.flat_with.data() + begin,
          static_cast<std::size_t>(shape.flat_with_begin[face + 1]) - begin};
}

/// Half width of a pinacoid along n: largest n . x over its points.
inline double half_width(const PinacoidHalves& w, const Vector& n) {
  const double x = n.x() < 0 ? -n.x() : n.x(), y = n.y() < 0 ? -n.y() : n.y();
  const double z = n.z() < 0 ? -n.z() : n.z();
  const double waist = w.a * x + w.b * y, ridge = w.c * x + w.e * z;
  return waist < ridge ? ridge : waist;
}

/// The vertex farthest along n; the first of equals.
inline std::int32_t farthest_vertex(const ConvexShape& shape, const Vector& n) {
  std::size_t best = 0;
  double reach = n.dot(shape.vertices[0]);
  for (std::size_t k = 1; k < shape.vertices.size(); ++k) {
    const double along = n.dot(shape.vertices[k]);
    best = along > reach ? k : best;
    reach = along > reach ? along : reach;
  }
  return static_cast<std::int32_t>(best);
}

/// Largest n . x over the shape, d. For a sphere n must be a unit vector.
inline double reach_along(const ConvexShape& shape, const Vector& n) {
  if (shape.is_ball) return shape.inradius;
  double reach = n.dot(shape.vertices[0]);
  for (std::size_t k = 1; k < shape.vertices.size(); ++k) {
    const double along = n.dot(shape.vertices[k]);
    reach = along > reach ? along : reach;
  }
  return reach;
}

}  // namespace grainsweep
