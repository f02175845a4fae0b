#include "runner/sweep/shape_kind.hpp"

#include <algorithm>

namespace grainsweep {
namespace {

bool is_hull(ShapeKind kind) { return kind >= ShapeKind::hull; }

}  // namespace

ShapeKind shape_named_by(const Assignment& assignment) {
  switch (parameters()[assignment.parameter].role) {
    case Role::shape:
      return std::get<std::int64_t>(assignment.value) == 0 ? ShapeKind::sphere
                                                           : ShapeKind::pinacoid;
    case Role::pinacoid:
      return ShapeKind::pinacoid;
    case Role::hull_vertices:
      return ShapeKind::hull_vertices;
    case Role::hull_file:
      return ShapeKind::hull_file;
    case Role::hull_size:
      return ShapeKind::hull;
    default:
      return ShapeKind::none;
  }
}

bool exclude_each_other(ShapeKind a, ShapeKind b) {
  if (a == ShapeKind::none || b == ShapeKind::none || a == b) return false;
  const bool is_part = a == ShapeKind::hull || b == ShapeKind::hull;
  return !(is_part && is_hull(a) && is_hull(b));
}

ShapeKind more_exact(ShapeKind a, ShapeKind b) { return std::max(a, b); }

}  // namespace grainsweep
