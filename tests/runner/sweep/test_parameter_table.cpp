#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>

#include <catch2/catch.hpp>

#include "runner/sweep/parameter_table.hpp"
#include "runner/sweep/parameters.hpp"

namespace grainsweep {
namespace {

struct Bound {
  double value = 0.0;
  bool is_allowed = false;
};

double number_in(const std::string& text, std::size_t from) {
  double value = 0.0;
  const auto end = std::from_chars(text.data() + from, text.data() + text.size(), value);
  REQUIRE(end.ec == std::errc{});
  return value;
}

Bound lower_bound(const std::string& range) {
  return {number_in(range, range.front() == '>' ? 2 : 1), range.front() == '['};
}

/// Nothing if the range goes on for ever.
std::optional<Bound> upper_bound(const std::string& range) {
  if (range.front() == '>') return std::nullopt;
  return Bound{number_in(range, range.find(' ') + 1), range.back() == ']'};
}

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
  CHECK(table.find("| `accuracy.preset` | name | `\"fast\"`, `\"balanced\"`, `\"accurate\"` | "
                   "`\"balanced\"` |") != std::string::npos);
}

TEST_CASE("what lies outside a documented range is refused") {
  int ranges = 0;
  for (const Parameter& parameter : parameters()) {
    const bool is_of_the_engine = parameter.role == Role::plain || parameter.role == Role::fill ||
                                  parameter.role == Role::pinacoid;
    if (parameter.range.empty() || !is_of_the_engine) continue;
    INFO(parameter.path << " " << parameter.range);
    const Bound low = lower_bound(parameter.range);
    CHECK(is_refused(parameter, low.is_allowed ? next_after(parameter, low.value, -1) : low.value));
    if (const auto high = upper_bound(parameter.range)) {
      const bool is_largest = high->value >= std::numeric_limits<int>::max();
      if (is_largest) continue;  // the reader refuses it before
      CHECK(is_refused(parameter,
                       high->is_allowed ? next_after(parameter, high->value, 1) : high->value));
    }
    ++ranges;
  }
  CHECK(ranges >= 20);
}

TEST_CASE("the bounds that a documented range holds are allowed where nothing else forbids them") {
  // Those that other parameters narrow: sides by the largest grain, counts and heights by each
  // other, bins by the width of the box, the angle of a pinacoid by its sides.
  for (const char* path :
       {"sizes.spread", "sizes.small_share", "sizes.size_ratio", "accuracy.step",
        "accuracy.momentum", "accuracy.fall_iterations", "accuracy.creep_steps",
        "accuracy.rest_iterations", "accuracy.max_steps", "measure.exclude_floor",
        "measure.exclude_surface", "shape.pinacoid.angle_deg"}) {
    const Parameter& parameter = parameters()[*find_parameter(path)];
    INFO(path << " " << parameter.range);
    const Bound low = lower_bound(parameter.range), high = *upper_bound(parameter.range);
    if (low.is_allowed) CHECK_FALSE(is_refused(parameter, low.value));
    if (high.is_allowed) CHECK_FALSE(is_refused(parameter, high.value));
  }
}

}  // namespace grainsweep
