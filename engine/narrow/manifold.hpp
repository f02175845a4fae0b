// Contacts of two convex shapes: narrow phase from the cheapest test to the points of contact.
//
// Every point of the contact polygon is kept: with fewer points than the polygon has corners a
// grain has no balance of torques and cannot rest without friction. A face is preferred to a pair
// of edges unless the edges' separation is larger by the `preference`: an edge axis that wins by
// rounding would replace a polygon by a single point. In a moving bed the preference is of the
// order of g dt^2. What touches must lie above that face, though: beside the narrow faces of a
// prism with many sides it often does not, and grains held by such a face would sink into each
// other.
#pragma once

#include <limits>
#include <vector>

#include "engine/narrow/gjk.hpp"
#include "engine/narrow/separating_axes.hpp"
#include "engine/scene/box.hpp"

namespace grainsweep {

struct TouchSettings {
  double margin = 0.0;      ///< points with a gap up to this are contacts, d
  double preference = 0.0;  ///< of faces over edges, d
  double of_depth = 0.0;    ///< added to the preference: this times the overlap along the edges
};

/// What a pair remembers from step to step; a default one is always allowed.
struct PairMemory {
  Vector axis = Vector::Zero();  ///< the axis that parted it best, or along which it touched; zero
                                 ///< at first
  bool touched = false;          ///< whether it touched; then no time is lost on parting it along
                                 ///< `axis`
  AxisCandidates candidates;
};

/// A point of contact.
struct ContactPoint {
  Vector position =
      Vector::Zero();  ///< midway between the surfaces, frame of a, about its centre, d
  /// Along the normal, d; negative = overlap. Points beside a face are not part of its contact, so
  /// that within the margin the least gap may exceed the distance of the shapes by up to 0.04 d.
  double gap = 0.0;
};

/// Least gap of one point or more, d.
double min_gap(const ContactPoint* points, std::size_t count);

/// For a contact of edges, their directions in ConvexShape::edge_directions; else -1.
struct CrossedEdges {
  std::int32_t of_a = -1, of_b = -1;
};

/// Contact of two grains; its points are `points[first]` .. `points[first + count - 1]`.
struct PairContact {
  Vector normal = Vector::Zero();  ///< unit, from a to b, frame of a; the same for all points
  /// Along the normal, d; no more than the least gap, but that points on a face nearly flat with
  /// the one touched have gaps along its own normal. If there is no contact, a separation that
  /// parts the shapes.
  double separation = 0.0;
  AxisKind kind = AxisKind::none;  ///< what gave the normal; none = no contact within the margin
  std::size_t first = 0, count = 0;
  /// Its one point does not show that the shapes are within the margin: the touching features lie
  /// beside each other.
  bool is_beside = false;
  CrossedEdges edges = {};
  /// Separation along the best of all axes, which a preferred one need not be, d: as far as the
  /// shapes overlap at all. Lowest where the axis is the only one.
  double parted = std::numeric_limits<double>::lowest();
};

/// Working memory, kept from call to call.
struct ClipColumns {
  std::vector<Vector> polygon, clipped;
  std::vector<double> beyond;  ///< how far beyond a side each corner of the polygon lies, d
  std::vector<double> reach;   ///< of the vertices of a shape along a normal, d
  const HullKernels* kernels = &kernels_for(best_isa()).hull;
};

struct TouchColumns {
  AxisColumns axes;
  ClipColumns clip;

  void use(const Kernels& kernels) { axes.kernels = clip.kernels = &kernels.hull; }
};

/// The contact of a pair; its points are appended to `points`. No contact (count 0) if the shapes
/// are further apart than the margin.
PairContact touch(const ShapePair& pair, const TouchSettings& settings, PairMemory& memory,
                  TouchColumns& columns, std::vector<ContactPoint>& points);

/// The same with the axes known, as from the batch kernel. Apart along them by less than the margin
/// counts as near: corners beside each other may be further apart than that, and give a contact
/// with PairContact::is_beside.
PairContact touch(const ShapePair& pair, const TouchSettings& settings, const ContactAxes& axes,
                  ClipColumns& columns, std::vector<ContactPoint>& points);

/// Appends every vertex of the grain whose gap to the wall is no more than `margin`, or the point
/// of a sphere that is nearest to it; returns their number. Positions are those of the points in
/// the frame of the grain, about its centre, d. A round wall is taken for the plane that touches it
/// beside the grain's centre: right for spheres, for polyhedra see touch_wall in
/// engine/narrow/polyhedra.hpp.
std::size_t touch_wall(const ConvexShape& shape, const Pose& pose, const Wall& wall, double margin,
                       std::vector<ContactPoint>& points);

}  // namespace grainsweep
