// Contact polygons: what of one convex shape lies above a face of another.
#pragma once

#include "engine/narrow/manifold.hpp"

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

/// Which of a pair's shapes.
enum class Of { a, b };

/// Appends the contact points on face `face` of the shape `reference` of a pair, gaps along the
/// face's normal: the polygon of the other shape's touching face cut by the sides of the face, and
/// its other vertices above the face; all up to `margin`. Of the faces at its lowest vertex the
/// touching one is that which faces `face` most. Appends nothing if it lies beside the face.
void clip_on_face(const ShapePair& pair, Of reference, std::int32_t face, double margin,
                  ClipColumns& columns, std::vector<ContactPoint>& points);

struct Segment {
  Vector from, to;
};

/// The edge of a direction (index of edge_directions) that reaches farthest along n.
Segment farthest_edge(const PlacedShape& shape, std::int32_t direction, const Vector& n);

/// The shortest line between two segments.
struct Closeness {
  Vector midway;
  double distance;  ///< d
};

/// Of segments that are not parallel.
Closeness closest_of(const Segment& p, const Segment& q);

}  // namespace grainsweep
