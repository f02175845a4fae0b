// Contact polygons: the part of one convex shape that lies above a face of another.
#pragma once

#include "engine/narrow/manifold.hpp"

namespace grainsweep {

/// Which of a pair's shapes.
enum class Of { a, b };

/// Appends the contact points on face `face` of the shape `reference` of a pair, gaps along the
/// face's normal: the polygon of the other shape's touching face cut by the sides of the face, and
/// its other vertices above the face, and where its other edges that lie on the face leave it; all
/// up to `margin`. The touching face is the one, of those at the other shape's lowest vertex, that
/// faces `face` most. Faces that are nearly flat with either count as parts of it. Appends nothing
/// if all lie beside each other.
void clip_on_face(const ShapePair& pair, Of reference, std::int32_t face, double margin,
                  ClipColumns& columns, std::vector<ContactPoint>& points);

struct Segment {
  Vector from, to;  ///< frame of a, d
};

/// Of the edges of one shape along a direction (index of edge_directions), the one that reaches
/// farthest along n, all in the frame of a.
Segment farthest_edge(const ShapePair& pair, Of which, std::int32_t direction, const Vector& n);
/// The shortest line between two segments.
struct Closeness {
  Vector midway;    ///< frame of a, d
  double distance;  ///< d
};

Closeness closest_of(const Segment& p, const Segment& q);

}  // namespace grainsweep
