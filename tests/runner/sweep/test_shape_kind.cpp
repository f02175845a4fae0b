#include <catch2/catch.hpp>

#include "runner/sweep/shape_kind.hpp"

namespace grainsweep {
namespace {

ShapeKind named_by(const char* path, const Value& value = 1.0) {
  return shape_named_by({*find_parameter(path), value, ""});
}

}  // namespace

TEST_CASE("a shape is named by its name and by each of its parts, by nothing else") {
  CHECK(named_by("shape", std::int64_t{0}) == ShapeKind::sphere);
  CHECK(named_by("shape", std::int64_t{1}) == ShapeKind::pinacoid);
  CHECK(named_by("shape.pinacoid.angle_deg") == ShapeKind::pinacoid);
  CHECK(named_by("shape.hull.vertices", Points{}) == ShapeKind::hull_vertices);
  CHECK(named_by("shape.hull.file", std::string("a.obj")) == ShapeKind::hull_file);
  CHECK(named_by("shape.hull.size") == ShapeKind::hull);
  for (const Parameter& parameter : parameters()) {
    if (parameter.path.starts_with("shape")) continue;
    CHECK(named_by(parameter.path.c_str()) == ShapeKind::none);
  }
}

TEST_CASE("shapes exclude each other, parts of one shape do not") {
  using enum ShapeKind;
  const std::vector kinds = {none, sphere, pinacoid, hull, hull_vertices, hull_file};
  int excluding = 0;
  for (const ShapeKind a : kinds) {
    CHECK_FALSE(exclude_each_other(a, a));
    CHECK_FALSE(exclude_each_other(a, none));
    for (const ShapeKind b : kinds) {
      CHECK(exclude_each_other(a, b) == exclude_each_other(b, a));
      excluding += exclude_each_other(a, b) ? 1 : 0;
    }
  }
  // Of the ten pairs of kinds two are parts of one hull.
  CHECK(excluding == 2 * (10 - 2));
  CHECK_FALSE(exclude_each_other(hull, hull_file));
  CHECK_FALSE(exclude_each_other(hull, hull_vertices));
  CHECK(exclude_each_other(hull_file, hull_vertices));
}

TEST_CASE("where vertices come from says more than that grains are hulls") {
  CHECK(more_exact(ShapeKind::hull, ShapeKind::hull_file) == ShapeKind::hull_file);
  CHECK(more_exact(ShapeKind::hull_vertices, ShapeKind::hull) == ShapeKind::hull_vertices);
  CHECK(more_exact(ShapeKind::none, ShapeKind::sphere) == ShapeKind::sphere);
}

}  // namespace grainsweep
