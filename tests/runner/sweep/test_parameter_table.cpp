#include <algorithm>
#include <cmath>
#include <limits>

#include <catch2/catch.hpp>

#include "runner/sweep/parameter_table.hpp"
#include "runner/sweep/parameters.hpp"

namespace grainsweep {
namespace {

bool is_refused(const Parameter& parameter, double number) {
  ResolvedSpec in_effect;
  Value value = number;
  if (parameter.kind == ValueKind::whole) value = static_cast<std::int64_t>(number);
  if (parameter.kind == ValueKind::numbers) value = std::vector<double>{number};
  parameter.set(in_effect, value);
  const auto errors = check(in_effect.spec);
  return std::any_of(errors.begin(), errors.end(), [&](const SpecError& error) {
    return parameter.path.starts_with(error.path);
  });
}

double next_after(const Parameter& parameter, double value, double direction) {
  if (parameter.kind == ValueKind::whole) return value + direction;
  return std::nextafter(value, value + direction);
}

}  // namespace

TEST_CASE("the documentation names every parameter with its meaning and its default") {
  const std::string table = parameter_table();
  for (const Parameter& parameter : parameters()) {
    CHECK(table.find("| `" + parameter.path + "` | ") != std::string::npos);
  }
  CHECK(table.find("| `box.width` | number | [1, 10000] | `10.0` | extent of the box along y, d: "
                   "the gap between walls |\n") != std::string::npos);
  CHECK(table.find("`\"periodic\"`, `\"walls\"` | `\"walls\"` |") != std::string::npos);
  CHECK(
      table.find(
          "| `accuracy.preset` | name | `\"fast\"`, `\"balanced\"`, `\"accurate\"`, `\"exact\"` | "
          "`\"balanced\"` |") != std::string::npos);
}

TEST_CASE("what lies outside a documented range is refused") {
  int ranges = 0;
  for (const Parameter& parameter : parameters()) {
    const bool is_of_the_engine = parameter.role == Role::plain || parameter.role == Role::fill ||
                                  parameter.role == Role::shape_part ||
                                  parameter.role == Role::box || parameter.role == Role::tube ||
                                  parameter.role == Role::size_class ||
                                  parameter.role == Role::size_formula;
    if (!parameter.range || !is_of_the_engine) continue;
    const Interval& range = *parameter.range;
    INFO(parameter.path << " " << range.text());
    CHECK(is_refused(parameter, range.low_open ? range.low : next_after(parameter, range.low, -1)));
    ++ranges;
    if (range.high >= std::numeric_limits<int>::max()) continue;  // the reader refuses more
    CHECK(
        is_refused(parameter, range.high_open ? range.high : next_after(parameter, range.high, 1)));
  }
  CHECK(ranges >= 20);
}

TEST_CASE("the bounds that a documented range holds are allowed where nothing else forbids them") {
  // Others are narrowed by what stands beside them: sides by the largest grain, counts and heights
  // by each other, zones left out by the bed's height, steps, short or few, by its fall, bins by
  // the box's width.
  for (const char* path : {"sizes.spread", "sizes.small_share", "sizes.size_ratio",
                           "accuracy.momentum", "accuracy.fall_iterations", "accuracy.creep_steps",
                           "accuracy.rest_iterations", "shape.pinacoid.angle_deg"}) {
    const Parameter& parameter = parameters()[*find_parameter(path)];
    const Interval& range = parameter.range.value();
    INFO(path << " " << range.text());
    if (!range.low_open) CHECK_FALSE(is_refused(parameter, range.low));
    if (!range.high_open) CHECK_FALSE(is_refused(parameter, range.high));
  }
  CHECK_FALSE(is_refused(parameters()[*find_parameter("accuracy.step")], 2.0));
}

}  // namespace grainsweep
