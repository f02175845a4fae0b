// Contact polygons: what of one convex shape lies above a face of another.
#pragma once

#include "engine/contact/touch.hpp"

namespace grainsweep {

/// A shape in the frame of grain a: its point x lies at centre + scale * turn x.
struct PlacedShape {
  const ConvexShape& shape;
  Vector centre;
  Matrix turn;
  double scale;

  Vector place(std::int32_t vertex) const {
    return centre + scale * (turn * shape.vertices[static_cast<std::size_t>(vertex)]);
  }
};
PlacedShape placed_a(const ShapePair& pair);
PlacedShape placed_b(const ShapePair& pair);

/// Appends the contact points of `other` on face `face` of `base`, gaps along the face's normal:
/// the polygon of its touching face cut by the sides of the face, and its other vertices above the
/// face; all up to `margin`. Of the faces at its lowest vertex the touching one is that which faces
/// `face` most. Appends nothing if `other` lies beside the face.
void clip_on_face(const PlacedShape& base, std::int32_t face, const PlacedShape& other,
                  double margin, ClipColumns& columns, std::vector<ContactPoint>& points);

struct Segment {
  Vector from, to;
};

/// The edge of a direction (index of edge_directions) that reaches farthest along n.
Segment farthest_edge(const PlacedShape& shape, std::int32_t direction, const Vector& n);

/// The middle of the shortest line between two segments that are not parallel.
Vector midway(const Segment& p, const Segment& q);

}  // namespace grainsweep
