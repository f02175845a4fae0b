#include "runner/sweep/values.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <utility>

#include "runner/sweep/mixture_components.hpp"
#include "runner/sweep/suggest.hpp"
#include "runner/sweep/text_lines.hpp"

namespace grainsweep {
namespace {

ValueReading fits(Value value) { return {std::move(value), ""}; }

/// A number at the front of a text, and what follows it without blanks; nothing if none is there.
std::optional<std::pair<double, std::string_view>> number_with_unit(const Json& value) {
  if (!value.is_string()) return std::nullopt;
  const auto& text = value.get_ref<const std::string&>();
  double number = 0.0;
  const char* const end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, number);
  if (read.ec != std::errc()) return std::nullopt;
  return std::pair(number, trimmed({read.ptr, static_cast<std::size_t>(end - read.ptr)}));
}

/// What to do where a length is given in a unit.
std::string of_length(const Parameter& parameter, const Json& value) {
  constexpr std::array units = {"um", "µm", "mm", "cm", "m"};
  const auto given = number_with_unit(value);
  const bool has_unit =
      given && std::find(units.begin(), units.end(), given->second) != units.end();
  if (!has_unit || parameter.unit != "d") return "";
  return "; lengths are in d, the mean diameter of the large grains: write how many of them it is";
}

ValueReading mismatch(const Parameter& parameter, const Json& value) {
  const bool is_number = parameter.kind == ValueKind::number && value.is_string();
  return {{},
          "must be " + wanted_value(parameter) + ", is " + describe(value) +
              (is_number ? of_percent(value) + of_length(parameter, value) : "")};
}

ValueReading read_number(const Parameter& parameter, const Json& value) {
  if (!value.is_number()) return mismatch(parameter, value);
  return fits(value.get<double>() + 0.0);  // -0 and 0 are one value
}

/// 1e4 is a whole number too, as long as f64 holds it exactly.
bool is_whole(const Json& value) {
  if (value.is_number_integer()) return true;
  constexpr double largest_exact = 9007199254740992.0;
  if (!value.is_number_float()) return false;
  const double number = value.get<double>();
  return number == std::floor(number) && std::abs(number) <= largest_exact;
}

ValueReading read_whole(const Parameter& parameter, const Json& value) {
  const bool small = !value.is_number_unsigned() ||
                     value.get<std::uint64_t>() <= static_cast<std::uint64_t>(parameter.largest);
  if (!is_whole(value) || !small) return mismatch(parameter, value);
  const auto number = value.get<std::int64_t>();
  if (number > parameter.largest || number < -parameter.largest) return mismatch(parameter, value);
  return fits(number);
}

ValueReading read_natural(const Parameter& parameter, const Json& value) {
  const bool negative = value.is_number() && value.get<double>() < 0.0;
  if (!is_whole(value) || negative) return mismatch(parameter, value);
  return fits(value.get<std::uint64_t>());
}

/// What a shape without defaults needs; "" for other names.
std::string needed_by(const std::string& shape) {
  if (shape == "hull") {
    return R"(a hull needs its vertices: write {"hull": {"file": "stone.stl"}})";
  }
  if (shape == "mixture") {
    return "a mixture needs its components: write "
           R"({"mixture": [{"share": 0.5, "sphere": {}}, {"share": 0.5, "cube": {}}]})";
  }
  return "";
}

ValueReading read_choice(const Parameter& parameter, const Json& value) {
  const auto& names = parameter.choices;
  if (!value.is_string()) return mismatch(parameter, value);
  const auto& name = value.get_ref<const std::string&>();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end()) return fits(static_cast<std::int64_t>(found - names.begin()));
  if (parameter.role == Role::shape && !needed_by(name).empty()) return {{}, needed_by(name)};
  ValueReading reading = mismatch(parameter, value);
  const auto& former = parameter.former_choices;
  if (std::find(former.begin(), former.end(), name) != former.end()) {
    reading.error += ", which this version no longer has; take \"" + names.back() + "\"";
    return reading;
  }
  if (const auto why = why_not_packed(name); parameter.role == Role::shape && !why.empty()) {
    reading.error += "; " + why;
    return reading;
  }
  const std::string near = nearest(name, names);
  if (!near.empty()) reading.error += "; did you mean \"" + near + "\"?";
  return reading;
}

bool is_written_text(const Json& value) {
  return value.is_string() && !value.get_ref<const std::string&>().empty();
}

ValueReading read_text(const Parameter& parameter, const Json& value) {
  if (!is_written_text(value)) return mismatch(parameter, value);
  return fits(value.get<std::string>());
}

/// The error of a list that holds this entry.
ValueReading wrong_entry(const Parameter& parameter, const Json& entry) {
  return {{}, "must be " + wanted_value(parameter) + ", holds " + describe(entry)};
}

ValueReading read_texts(const Parameter& parameter, const Json& value) {
  if (!value.is_array() || value.empty()) return mismatch(parameter, value);
  const auto other = std::find_if_not(value.begin(), value.end(), is_written_text);
  if (other != value.end()) return wrong_entry(parameter, *other);
  return fits(value.get<std::vector<std::string>>());
}

ValueReading read_numbers(const Parameter& parameter, const Json& value) {
  const auto is_number = [](const Json& entry) { return entry.is_number(); };
  if (!value.is_array()) return mismatch(parameter, value);
  const auto other = std::find_if_not(value.begin(), value.end(), is_number);
  if (other != value.end()) return wrong_entry(parameter, *other);
  auto numbers = value.get<std::vector<double>>();
  for (double& number : numbers) number += 0.0;  // -0 and 0 are one value
  return fits(std::move(numbers));
}

bool is_point(const Json& value) {
  const auto is_number = [](const Json& entry) { return entry.is_number(); };
  return value.is_array() && value.size() == 3 &&
         std::all_of(value.begin(), value.end(), is_number);
}

/// What is wrong with a vertex, counted from one.
std::string vertex_error(std::size_t number, const Json& value) {
  const std::string start =
      "vertex " + std::to_string(number) + " must be three numbers [x, y, z], ";
  if (!value.is_array()) return start + "is " + describe(value);
  const auto other = std::find_if_not(value.begin(), value.end(),
                                      [](const Json& entry) { return entry.is_number(); });
  if (other != value.end()) return start + "holds " + describe(*other);
  return start + "holds " + std::to_string(value.size()) + " values";
}

ValueReading read_points(const Parameter& parameter, const Json& value) {
  if (!value.is_array()) return mismatch(parameter, value);
  Points points;
  for (const Json& entry : value) {
    if (!is_point(entry)) return {{}, vertex_error(points.size() + 1, entry)};
    auto point = entry.get<std::array<double, 3>>();
    for (double& coordinate : point) coordinate += 0.0;  // -0 and 0 are one value
    points.push_back(point);
  }
  return fits(std::move(points));
}

/// The first problem stands for all.
ValueReading read_mixture(const Parameter& /*parameter*/, const Json& value) {
  Diagnostics diagnostics;
  auto components = read_components(value, "", diagnostics);
  if (!components) return {{}, diagnostics.front().message};
  return fits(std::move(*components));
}

struct WrittenJson {
  nlohmann::json operator()(const Components& components) const {
    auto list = nlohmann::json::array();
    for (const WrittenComponent& one : components) list.push_back(nlohmann::json::parse(one.text));
    return list;
  }
  template <class Known>
  nlohmann::json operator()(const Known& value) const {
    return nlohmann::json(value);
  }
};

/// How values of a kind are called, asked for and read.
struct KindFacts {
  const char* name;
  const char* wanted;  ///< empty: the names to choose from
  ValueReading (*read)(const Parameter&, const Json&);
};

const KindFacts& facts_of(ValueKind kind) {
  static constexpr std::array<KindFacts, 9> facts = {{
      {"number", "a number", read_number},
      {"whole number", "a whole number", read_whole},
      {"whole number", "a whole number in digits from 0 to 18446744073709551615", read_natural},
      {"name", "", read_choice},
      {"text", "the name of a file in double quotes", read_text},
      {"list of texts", "a list of names of files in double quotes", read_texts},
      {"list of numbers", "a list of numbers", read_numbers},
      {"list of points", "a list of points [x, y, z]", read_points},
      {"list of components", "a list of components", read_mixture},
  }};
  static_assert(static_cast<std::size_t>(ValueKind::components) + 1 == facts.size());
  return facts[static_cast<std::size_t>(kind)];
}

std::string up_to(const Parameter& parameter) {
  if (parameter.range && !std::isinf(parameter.range->high)) {
    return " in " + parameter.range->text();
  }
  if (parameter.largest == std::numeric_limits<std::int64_t>::max()) return "";
  return " up to " + std::to_string(parameter.largest);
}

}  // namespace

ValueReading read_value(const Parameter& parameter, const Json& value) {
  return facts_of(parameter.kind).read(parameter, value);
}

std::string range_error(const Parameter& parameter, const Value& value) {
  if (!parameter.range) return "";
  std::vector<double> numbers;
  if (const auto* number = std::get_if<double>(&value)) numbers = {*number};
  if (const auto* whole = std::get_if<std::int64_t>(&value)) {
    numbers = {static_cast<double>(*whole)};
  }
  if (const auto* list = std::get_if<std::vector<double>>(&value)) numbers = *list;
  for (const double number : numbers) {
    if (parameter.range->holds(number)) continue;
    const bool is_bounded = !std::isinf(parameter.range->high);
    return (is_bounded ? "must lie in " : "must be ") + parameter.range->text() + ", is " +
           bound_text(number) + (parameter.is_share ? percent_hint(*parameter.range, number) : "");
  }
  return "";
}

std::string of_percent(const Json& value) {
  if (value.is_number()) return percent_hint({0.0, 1.0}, value.get<double>());
  const auto given = number_with_unit(value);
  return given && given->second == "%" ? "; write " + bound_text(given->first / 100.0) : "";
}

std::string why_not_packed(std::string_view shape) {
  constexpr std::array names = {"ring",    "rings",    "torus",       "tube",   "hollow_cylinder",
                                "raschig", "trilobe",  "quadrilobe",  "saddle", "star",
                                "cross",   "dumbbell", "raschig_ring"};
  if (std::find(names.begin(), names.end(), shape) == names.end()) return "";
  return "a " + std::string(shape) + " is not convex, and only convex shapes are packed";
}

std::optional<std::int64_t> whole_number_in(const Json& value, std::int64_t low, std::int64_t high,
                                            const std::string& pointer, Diagnostics& diagnostics) {
  // As doubles, for the bounds are far below those of exact numbers.
  if (is_whole(value) && value.get<double>() >= static_cast<double>(low) &&
      value.get<double>() <= static_cast<double>(high)) {
    return value.get<std::int64_t>();
  }
  diagnostics.push_back({pointer, "must be a whole number in [" + std::to_string(low) + ", " +
                                      std::to_string(high) + "], is " + describe(value)});
  return std::nullopt;
}

nlohmann::json written_value(const Parameter& parameter, const Value& value) {
  if (parameter.kind == ValueKind::choice) {
    return parameter.choices[static_cast<std::size_t>(std::get<std::int64_t>(value))];
  }
  return std::visit(WrittenJson(), value);
}

std::string describe(const Json& value) {
  if (value.is_object()) return "an object";
  if (value.is_array()) return value.empty() ? "an empty list" : "a list";
  if (value.is_string()) return "the text \"" + shortened(value.get<std::string>()) + "\"";
  return value.dump();
}

const char* name_of(ValueKind kind) { return facts_of(kind).name; }

std::string wanted_value(const Parameter& parameter) {
  if (parameter.kind != ValueKind::choice) {
    return facts_of(parameter.kind).wanted +
           (parameter.kind == ValueKind::whole ? up_to(parameter) : "");
  }
  const bool is_more = is_group(parameter.path);
  std::string names;
  for (const std::string& name : parameter.choices) {
    const bool last = !is_more && &name == &parameter.choices.back();
    names += (names.empty() ? "\"" : last ? " or \"" : ", \"") + name + "\"";
  }
  return is_more ? names + " or an object with " + short_list(known_keys(parameter.path)) : names;
}

std::string in_thousands(std::uint64_t count) {
  std::string digits = std::to_string(count);
  for (std::size_t at = digits.size(); at > 3; at -= 3) digits.insert(at - 3, 1, ',');
  return digits;
}

double nine_digits(double value) {
  char text[40];
  const auto written =
      std::to_chars(text, text + sizeof text, value, std::chars_format::general, 9);
  double rounded = value;
  std::from_chars(text, written.ptr, rounded);
  return rounded;
}

}  // namespace grainsweep
