// Which shape an assignment names: spheres, pinacoids and hulls are one choice, and so are the two
// ways to give the vertices of a hull.
#pragma once

#include "runner/sweep/assignments.hpp"

namespace grainsweep {

enum class ShapeKind {
  none,           ///< the assignment is about something else
  sphere,         ///< "shape": "sphere"
  pinacoid,       ///< "shape": "pinacoid", or a part of it
  hull,           ///< a part of either hull
  hull_vertices,  ///< a hull of vertices that are written out
  hull_file,      ///< a hull of vertices from a file
};

ShapeKind shape_named_by(const Assignment& assignment);

/// Whether grains cannot be both.
bool exclude_each_other(ShapeKind a, ShapeKind b);

/// The kind that says more: of a hull, where its vertices come from.
ShapeKind more_exact(ShapeKind a, ShapeKind b);

}  // namespace grainsweep
