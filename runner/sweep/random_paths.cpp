#include "runner/sweep/random_paths.hpp"

#include <optional>

#include "runner/sweep/suggest.hpp"
#include "runner/sweep/values.hpp"

namespace grainsweep {
namespace {

const char* const wanted_distribution =
    "must be {\"uniform\": [a, b]}, {\"log_uniform\": [a, b]} or {\"choice\": [...]}";

std::optional<Distribution> distribution_named(const std::string& name) {
  if (name == "uniform") return Distribution::uniform;
  if (name == "log_uniform") return Distribution::log_uniform;
  if (name == "choice") return Distribution::choice;
  return std::nullopt;
}

/// Reads the bounds of a number; what is wrong with them, "" if nothing is.
std::string read_pair(const Json& bounds, RandomPath& random) {
  const bool is_pair =
      bounds.is_array() && bounds.size() == 2 && bounds[0].is_number() && bounds[1].is_number();
  if (!is_pair) return "must be a list of two numbers, is " + describe(bounds);
  random.low = bounds[0].get<double>();
  random.high = bounds[1].get<double>();
  if (random.low > random.high) return "the first bound must not exceed the second";
  if (random.distribution == Distribution::log_uniform && !(random.low > 0.0)) {
    return "the bounds of log_uniform must be positive, the first is " + describe(bounds[0]);
  }
  const Parameter& parameter = parameters()[random.parameter];
  for (const Json& bound : bounds) {
    const ValueReading reading = read_value(parameter, bound);
    if (!reading.value) return reading.error;
    if (std::string error = range_error(parameter, *reading.value); !error.empty()) return error;
  }
  return "";
}

bool read_bounds(const Json& bounds, const std::string& pointer, RandomPath& random,
                 Diagnostics& diagnostics) {
  if (!is_interval(random.path)) {
    diagnostics.push_back(
        {pointer, random.path + " is not drawn from an interval; use {\"choice\": [...]}"});
    return false;
  }
  random.parameter = *find_parameter(random.path);
  const std::string error = read_pair(bounds, random);
  if (!error.empty()) diagnostics.push_back({pointer, error});
  return error.empty();
}

bool read_choices(const Json& list, const std::string& pointer, RandomPath& random,
                  Diagnostics& diagnostics) {
  if (!list.is_array() || list.empty()) {
    diagnostics.push_back({pointer, "must be a list of at least one value, is " +
                                        (list.is_array() ? "empty" : describe(list))});
    return false;
  }
  const std::size_t before = diagnostics.size();
  for (std::size_t i = 0; i < list.size(); ++i) {
    Assignments& choice = random.choices.emplace_back();
    read_assignments(random.path, list[i], pointer + "/" + std::to_string(i), choice, diagnostics);
    refuse_double_assignments(choice, diagnostics);
  }
  return diagnostics.size() == before;
}

bool read_path(const Json& value, RandomPath& random, Diagnostics& diagnostics) {
  if (!is_known_path(random.path, random.pointer, diagnostics)) return false;
  if (!value.is_object() || value.size() != 1) {
    diagnostics.push_back(
        {random.pointer, std::string(wanted_distribution) + ", is " + describe(value)});
    return false;
  }
  const std::string& name = value.begin().key();
  const std::string pointer = child_pointer(random.pointer, name);
  const auto distribution = distribution_named(name);
  if (!distribution) {
    diagnostics.push_back(
        {pointer, unknown_key(name, {"uniform", "log_uniform", "choice"}), Anchor::key});
    return false;
  }
  random.distribution = *distribution;
  if (random.distribution != Distribution::choice) {
    return read_bounds(value.front(), pointer, random, diagnostics);
  }
  return read_choices(value.front(), pointer, random, diagnostics);
}

}  // namespace

std::vector<RandomPath> read_random_paths(const Json& random, const std::string& pointer,
                                          Diagnostics& diagnostics) {
  std::vector<RandomPath> paths;
  for (const auto& [path, value] : random.items()) {
    if (path == "count") continue;
    RandomPath read;
    read.path = path;
    read.pointer = child_pointer(pointer, path);
    if (read_path(value, read, diagnostics)) paths.push_back(std::move(read));
  }
  if (random.empty() || (random.size() == 1 && random.contains("count"))) {
    diagnostics.push_back(
        {pointer, "names no path to draw, e.g. \"box.width\": {\"uniform\": [5, 20]}"});
  }
  return paths;
}

std::uint64_t read_random_count(const Json& random, const std::string& pointer,
                                Diagnostics& diagnostics) {
  const auto found = random.find("count");
  if (found == random.end()) {
    diagnostics.push_back({pointer, "\"count\", the number of points to draw, is missing"});
    return 0;
  }
  const auto count =
      whole_number_in(*found, 1, most_random_points, child_pointer(pointer, "count"), diagnostics);
  return static_cast<std::uint64_t>(count.value_or(0));
}

}  // namespace grainsweep
