#include <catch2/catch.hpp>

#include "runner/sweep/shape_kind.hpp"

namespace grainsweep {
namespace {

std::string_view named_by(const char* path, const Value& value = 1.0) {
  return shape_named_by({*find_parameter(path), value, ""});
}

}  // namespace

TEST_CASE("a shape is named by its name and by each of its parts, by nothing else") {
  CHECK(named_by("shape", std::int64_t{0}) == "sphere");
  CHECK(named_by("shape", std::int64_t{1}) == "pinacoid");
  CHECK(named_by("shape.pinacoid.angle_deg") == "pinacoid");
  CHECK(named_by("shape.prism.sides", std::int64_t{5}) == "prism");
  CHECK(named_by("shape.hull.vertices", Points{}) == "hull.vertices");
  CHECK(named_by("shape.hull.file", std::string("a.obj")) == "hull.file");
  CHECK(named_by("shape.hull.size") == "hull");
  CHECK(named_by("shape.mixture", Components{}) == "mixture");
  CHECK(named_by("shape.mixture_by", std::int64_t{1}) == "mixture");
  for (const Parameter& parameter : parameters()) {
    if (parameter.path.starts_with("shape")) continue;
    CHECK(named_by(parameter.path.c_str()).empty());
  }
}

TEST_CASE("shapes exclude each other, parts of one shape do not") {
  std::vector<std::string_view> kinds = {"", "hull.vertices", "hull.file"};
  kinds.insert(kinds.end(), shape_names.begin(), shape_names.end());
  std::size_t excluding = 0;
  for (const std::string_view a : kinds) {
    CHECK_FALSE(exclude_each_other(a, a));
    CHECK_FALSE(exclude_each_other(a, ""));
    for (const std::string_view b : kinds) {
      CHECK(exclude_each_other(a, b) == exclude_each_other(b, a));
      excluding += exclude_each_other(a, b) ? 1 : 0;
    }
  }
  // Of all pairs of what names a shape two are parts of one hull.
  const std::size_t named = kinds.size() - 1;
  CHECK(excluding == named * (named - 1) - 2 * 2);
  CHECK_FALSE(exclude_each_other("hull", "hull.file"));
  CHECK_FALSE(exclude_each_other("hull", "hull.vertices"));
  CHECK(exclude_each_other("hull.file", "hull.vertices"));
}

TEST_CASE("where vertices come from says more than that grains are hulls") {
  CHECK(more_exact("hull", "hull.file") == "hull.file");
  CHECK(more_exact("hull.vertices", "hull") == "hull.vertices");
  CHECK(more_exact("", "sphere") == "sphere");
}

}  // namespace grainsweep
