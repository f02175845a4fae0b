// Where and how two grains that touch do so, or a grain and a wall: for lists of contacts.
#pragma once

#include "engine/measure/touching.hpp"

namespace grainsweep {

/// A contact of grain a with grain b, or of a grain with a wall.
struct ContactPlace {
  Vector normal = Vector::Zero();  ///< unit, from a to b, or from the grain to the wall; box frame
  /// Midway between the surfaces, in the middle of a line or an area, box frame, d. It lies beside
  /// grain a: for a contact across a periodic side, outside the box.
  Vector point = Vector::Zero();
  int constraints = 1;  ///< 1 at a point, as of spheres, 2 along a line, 3 over an area
};

/// Where the pair touches; points of a line or an area count if their gap is below `tolerance`, d.
/// Not for spheres whose centres coincide.
ContactPlace contact_place(const SphereBed& bed, const TouchingPair& pair, double tolerance);
ContactPlace contact_place(const PolyhedronBed& bed, const TouchingPair& pair, double tolerance);

/// The same for a grain and a wall.
ContactPlace contact_place(const SphereBed& bed, const TouchingWall& touching, double tolerance);
ContactPlace contact_place(const PolyhedronBed& bed, const TouchingWall& touching,
                           double tolerance);

/// A vertex of a polyhedron and how it lies at a round wall, where it is a contact of its own.
struct VertexPlace {
  std::int32_t vertex = 0;  ///< numbered as in ConvexShape::vertices
  double gap = 0.0;         ///< d
  ContactPlace place;
};

/// For each vertex, however far it is from the wall.
std::vector<VertexPlace> vertex_places(const PolyhedronBed& bed, const TouchingWall& touching);

}  // namespace grainsweep
