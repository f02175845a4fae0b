// How far two convex shapes are apart, or how deep they overlap: separating axes.
//
// The separation along a unit vector n is min n . x over b minus max n . x over a. Its largest
// value over the face normals of both and the cross products of their edges is minus the depth of
// an overlap (the shortest translation that parts the shapes), exactly; of shapes apart it is
// positive and at most their distance, which it reaches where a corner faces a face or edges cross.
//
// Few of a hull's edges can give the best axis. The axis of two edges counts only if it lies
// between the normals of the faces at both edges (their arcs on the Gauss map cross; Gregorius, GDC
// 2013). And where a corner of the other shape lies as deep below both faces at an edge as the best
// axis so far says, no normal between those of the two faces parts the shapes better: for most
// pairs no edge is left at all.
#pragma once

#include <vector>

#include "engine/narrow/shape_pair.hpp"
#include "kernels/kernels.hpp"

namespace grainsweep {

/// What gives a contact its normal.
enum class AxisKind {
  none,
  face_of_a,
  face_of_b,
  edges,
  ball_on_face,  ///< a sphere that touches a polyhedron there
  ball_on_edge,
  round,  ///< a sphere at a corner or at a sphere
};

/// A candidate direction of contact. `a` and `b` are the faces, or the edge directions, it is made
/// of; -1 where a shape has no part in it.
struct ContactAxis {
  AxisKind kind = AxisKind::none;
  std::int32_t a = -1, b = -1;
  Vector normal = Vector::Zero();  ///< unit, from a to b, frame of a
  double separation = 0.0;         ///< d; negative = overlap
};

/// The best face, and the best pair of edges if it parts the shapes better than that.
struct ContactAxes {
  ContactAxis face;
  ContactAxis edges;  ///< kind none if no edges do better than the face

  const ContactAxis& best() const { return edges.kind == AxisKind::none ? face : edges; }
  double separation() const { return best().separation; }
};

/// Heights of corners of one shape over the faces of the other.
struct CornerHeights {
  std::vector<std::int32_t> corners;  ///< vertices of the first shape
  /// Height of each corner over every face, corner after corner, padded as VectorColumns are, d.
  std::vector<double> heights;
  std::vector<double> least;         ///< bound of how far each face parts the shapes, d
  std::vector<std::uint64_t> below;  ///< which corners lie low over each face, as bits
  std::vector<double> reach;         ///< of the vertices along a normal, d
};

/// Edges in the frame of a, with the normals of the faces at them.
struct PlacedEdges {
  VectorColumns from;                ///< d
  VectorColumns along, left, right;  ///< unit vectors
  std::vector<const Edge*> edges;
  std::vector<double> parted;           ///< of each, as in kernels/hull_kernels.hpp, d
  std::vector<std::uint8_t> crossings;  ///< of each
};

/// The faces and edges that the best axis can come from while two hulls move little: all others
/// part them by less. Found when the two had hardly moved since the last call, for the pose then. A
/// default one is always allowed.
struct AxisCandidates {
  static constexpr std::size_t most_faces = 6, most_edges = 12;

  double centre[3] = {}, turn[9] = {};  ///< of grain b as a sees it, d
  bool is_set = false;                  ///< whether these are a pose
  bool is_listed = false;               ///< whether the candidates are those of this pose
  bool are_too_many = false;            ///< this pose has more than have room here
  std::uint8_t faces = 0, edges = 0;
  std::int16_t face[most_faces] = {};  ///< k of a, or -1 - k of b
  std::int16_t edge_of_a[most_edges] = {}, edge_of_b[most_edges] = {};
};

/// Working memory, kept from call to call, and the kernels to work with.
struct AxisColumns {
  const HullKernels* kernels = &kernels_for(best_isa()).hull;
  CornerHeights over_a, over_b;  ///< of corners of b over faces of a, and the other way round
  PlacedEdges edges_of_a;
};

/// Separation along the unit vector `normal` from a to b, d.
double separation_along(const ShapePair& pair, const Vector& normal);

/// The best axes, f64, of every face and every pair of edges that can be the best. Neither grain
/// may be a sphere (has_ball): it has no faces. Two pinacoids take their widths in closed form and
/// all 44 axes. `guess` is an axis near to the best one, such as that of the last step, or zero: it
/// saves time and changes nothing; so do candidates.
ContactAxes separating_axes(const ShapePair& pair, const Vector& guess, AxisCandidates& candidates,
                            AxisColumns& columns);

/// The same with no guess and with memory of its own.
ContactAxes separating_axes(const ShapePair& pair, const HullKernels& kernels);

/// How far the pair of a lane is apart at least by the batch kernel, d. `reach`: the larger of both
/// grains' scales and circumradii, d, which pinacoid_rounding refers to.
double parted_by(const PinacoidBlock& block, std::size_t lane, double reach);

/// The axes of two pinacoids that the batch kernel chose for a lane, measured anew in f64, with
/// the parallel edges that it left out. What it chose among nearly equal axes may be the second
/// best: the separation is then too small by up to pinacoid_rounding.
ContactAxes separating_axes(const ShapePair& pair, const PinacoidBlock& block, std::size_t lane);

}  // namespace grainsweep
