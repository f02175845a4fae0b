// How the rows of the table of parameters are made: parameters that are members of a specification,
// and parameters that are set and read by functions of their own; and the
// rows that stand in files of their own, those of shapes and of sizes.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "runner/sweep/parameters.hpp"

namespace grainsweep {

/// What is written for a member of this type.
template <class T>
constexpr ValueKind kind_of() {
  if constexpr (std::is_enum_v<T>) return ValueKind::choice;
  if constexpr (std::is_same_v<T, double>) return ValueKind::number;
  if constexpr (std::is_same_v<T, std::uint64_t>) return ValueKind::natural;
  if constexpr (std::is_same_v<T, int>) return ValueKind::whole;
  return ValueKind::numbers;
}

/// Built in place: g++ 12 warns, wrongly, about a value moved into the optional under sanitizers.
template <class T>
std::optional<Value> present(const T& value) {
  return std::optional<Value>(std::in_place, std::in_place_type<T>, value);
}

/// `members` leads from a specification to the parameter: &ResolvedSpec::spec, &PackingSpec::box,
/// &Box::x.
template <auto... members>
void set_member(ResolvedSpec& resolved, const Value& value) {
  auto& target = (resolved.*....*members);
  using T = std::remove_reference_t<decltype(target)>;
  if constexpr (std::is_enum_v<T> || std::is_same_v<T, int>) {
    target = static_cast<T>(std::get<std::int64_t>(value));
  } else {
    target = std::get<T>(value);
  }
}

/// The value of that member.
template <auto... members>
std::optional<Value> get_member(const ResolvedSpec& resolved) {
  const auto& source = (resolved.*....*members);
  using T = std::remove_cvref_t<decltype(source)>;
  if constexpr (std::is_enum_v<T> || std::is_same_v<T, int>) {
    return present<std::int64_t>(static_cast<std::int64_t>(source));
  } else {
    return present<T>(source);
  }
}

/// For what does not belong to a job's identity.
inline std::optional<Value> no_identity(const ResolvedSpec&) { return std::nullopt; }

/// Names, each with what it means.
using Names = std::vector<std::pair<std::string, std::string>>;

/// What may be written: numbers in a range, names, or whatever fits the parameter's kind.
struct WrittenValues {
  WrittenValues() = default;
  WrittenValues(Interval numbers) : range(numbers) {}
  WrittenValues(Names words) : names(std::move(words)) {}

  std::optional<Interval> range = {};
  Names names = {};
};

inline constexpr Interval positive = {.low = 0.0, .low_open = true};

/// The row of a parameter that is set and read by functions of its own.
inline Parameter own(const char* path, const WrittenValues& limits, const char* meaning,
                     ValueKind kind, Role role, void (*set)(ResolvedSpec&, const Value&),
                     std::optional<Value> (*get)(const ResolvedSpec&)) {
  Parameter parameter = {.path = path,
                         .meaning = meaning,
                         .kind = kind,
                         .largest = std::numeric_limits<int>::max(),
                         .set = set,
                         .get = get,
                         .role = role,
                         .range = limits.range};
  for (const auto& [name, what] : limits.names) {
    parameter.choices.push_back(name);
    parameter.choice_meanings.push_back(what);
  }
  return parameter;
}

/// The row with its numbers in `unit`.
inline Parameter in(const char* unit, Parameter parameter) {
  parameter.unit = unit;
  return parameter;
}

/// The row of a member of a packing's specification that is set and read as it is.
template <auto... members>
Parameter row(const char* path, const WrittenValues& limits, const char* meaning) {
  using T = std::remove_cvref_t<decltype((std::declval<PackingSpec&>().*....*members))>;
  return own(path, limits, meaning, kind_of<T>(), Role::plain,
             set_member<&ResolvedSpec::spec, members...>,
             get_member<&ResolvedSpec::spec, members...>);
}

/// The rows that say what the grains are. The shape's name comes before the parts that name a shape
/// too.
std::vector<Parameter> shape_parameters();

/// The shape, with its defaults, that the parameter `path` is a part of: "shape.prism.sides".
ShapeSpec shape_with_part(const std::string& path);

/// The rows about the sizes of grains: two classes, and the distributions in their place.
std::vector<Parameter> size_parameters();

/// Converts all diameters of a distribution to units of `size`, a length in their present unit.
void to_units_of(double size, SizeDistribution& distribution);

}  // namespace grainsweep
