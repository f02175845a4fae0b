// From corners and faces to a whole shape: everything that follows from them.
#pragma once

#include <vector>

#include "engine/shape/convex_shape.hpp"

namespace grainsweep {

/// Corners of each face, counter-clockwise from outside.
using Loops = std::vector<std::vector<std::int32_t>>;

/// Integrals over a closed polyhedron about the origin of its vertices.
struct MassMoments {
  double volume = 0.0;               ///< d^3
  Vector centroid = Vector::Zero();  ///< d
  Matrix second = Matrix::Zero();    ///< mean of x x^T over the volume, about the origin, d^2
};
MassMoments mass_moments(const std::vector<Vector>& vertices, const Loops& loops);

/// The shape of these vertices and faces. They must be closed and convex, with the centroid at the
/// origin and the principal axes along those of the frame.
ConvexShape build_shape(std::vector<Vector> vertices, const Loops& loops);

/// Area vector of a polygon (Newell): exact for flat ones, a best fit for others, d^2.
Vector area_vector(const std::vector<Vector>& vertices, const std::vector<std::int32_t>& loop);

/// Area of its surface, d^2.
double surface_area(const ConvexShape& shape);

/// Moments of inertia over mass from the mean of x x^T about the centroid: trace - second.
Matrix inertia_of(const Matrix& second);

}  // namespace grainsweep
