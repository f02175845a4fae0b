#include "runner/sweep/spaced_values.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "runner/sweep/misplaced_keys.hpp"
#include "runner/sweep/parameters.hpp"
#include "runner/sweep/suggest.hpp"
#include "runner/sweep/values.hpp"

namespace grainsweep {
namespace {

const std::string wanted = R"(must be a list of values or {"from": a, "to": b, "count": n})";

/// The number that a member of the range holds; notes what is wrong with it.
std::optional<double> end_of(const Parameter& parameter, const Json& range, const char* member,
                             const std::string& pointer, Diagnostics& diagnostics) {
  const Json& value = range.at(member);
  const ValueReading reading = read_value(parameter, value);
  std::string error = reading.value ? range_error(parameter, *reading.value) : reading.error;
  if (error.empty()) return value.get<double>();
  diagnostics.push_back({child_pointer(pointer, member), std::move(error)});
  return std::nullopt;
}

/// What is wrong with the members of a range; "" if nothing is.
std::string members_error(const Json& range) {
  static const std::vector<std::string> known = {"from", "to", "count"};
  if (!range.is_object()) return "is " + describe(range);
  if (range.contains("step")) return R"(has a "step"; write "count", the number of values)";
  const auto missing = std::find_if(known.begin(), known.end(), [&](const std::string& member) {
    return !range.contains(member);
  });
  if (missing != known.end()) return "has no \"" + *missing + "\"";
  for (const auto& [key, value] : range.items()) {
    const bool is_known = std::find(known.begin(), known.end(), key) != known.end();
    if (!is_known) return "has an unknown key \"" + shortened(key) + "\"";
  }
  return "";
}

}  // namespace

Json spaced_values(const std::string& path, const Json& range, const std::string& pointer,
                   Diagnostics& diagnostics) {
  if (!is_interval(path)) {
    const std::string lists = range.is_object() ? dotted_lists(path, range) : "";
    diagnostics.push_back({pointer, "must be a list of values, is " + describe(range) +
                                        (lists.empty() ? "" : "; write " + lists)});
    return nullptr;
  }
  if (const std::string error = members_error(range); !error.empty()) {
    diagnostics.push_back({pointer, wanted + ", " + error});
    return nullptr;
  }
  const Parameter& parameter = parameters()[*find_parameter(path)];
  const auto from = end_of(parameter, range, "from", pointer, diagnostics);
  const auto to = end_of(parameter, range, "to", pointer, diagnostics);
  const auto count = whole_number_in(range.at("count"), 2, most_spaced_values,
                                     child_pointer(pointer, "count"), diagnostics);
  if (!from || !to || !count) return nullptr;
  Json values = Json::array();
  for (std::int64_t k = 0; k < *count; ++k) {
    const double share = static_cast<double>(k) / static_cast<double>(*count - 1);
    const double value = k == 0            ? *from
                         : k == *count - 1 ? *to
                                           : nine_digits(*from + share * (*to - *from));
    if (parameter.kind != ValueKind::whole) {
      values.push_back(value);
    } else if (value == std::round(value)) {
      values.push_back(static_cast<std::int64_t>(value));
    } else {
      diagnostics.push_back({pointer, "must give whole numbers, gives " + Json(value).dump() +
                                          ": take another count, or a list of values"});
      return nullptr;
    }
  }
  return values;
}

}  // namespace grainsweep
