#include "runner/sweep/shape_kind.hpp"

#include <algorithm>

namespace grainsweep {
namespace {

bool is_hull(ShapeKind kind) { return kind >= ShapeKind::hull; }

}  // namespace

ShapeKind shape_named_by(const Setting& setting) {
  const std::string& path = parameters()[setting.parameter].path;
  if (!path.starts_with("shape")) return ShapeKind::none;
  if (path == "shape") {
    return std::get<std::int64_t>(setting.value) == 0 ? ShapeKind::sphere : ShapeKind::pinacoid;
  }
  if (path.starts_with("shape.pinacoid.")) return ShapeKind::pinacoid;
  if (path == "shape.hull.vertices") return ShapeKind::hull_vertices;
  return path == "shape.hull.file" ? ShapeKind::hull_file : ShapeKind::hull;
}

bool exclude_each_other(ShapeKind a, ShapeKind b) {
  if (a == ShapeKind::none || b == ShapeKind::none || a == b) return false;
  const bool is_part = a == ShapeKind::hull || b == ShapeKind::hull;
  return !(is_part && is_hull(a) && is_hull(b));
}

ShapeKind more_exact(ShapeKind a, ShapeKind b) { return std::max(a, b); }

}  // namespace grainsweep
