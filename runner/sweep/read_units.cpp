#include "runner/sweep/read_units.hpp"

#include <algorithm>

#include "engine/interval.hpp"
#include "runner/sweep/suggest.hpp"
#include "runner/sweep/values.hpp"

namespace grainsweep {
namespace {

constexpr Interval allowed_lengths{0.0, largest_length, true};
constexpr Interval densities{least_density, largest_density};

/// The number at `key`; none if it is wrong, which is noted.
std::optional<double> number_at(const std::string& key, const Json& value, const Interval& range,
                                const char* of, Diagnostics& diagnostics) {
  if (value.is_number() && range.holds(value.get<double>())) return value.get<double>();
  diagnostics.push_back({"/units/" + key, std::string("must be a number ") + of + "in " +
                                              range.text() + ", is " + describe(value)});
  return std::nullopt;
}

std::string unit_at(const Json& value, Diagnostics& diagnostics) {
  std::string unit = value.is_string() ? value.get<std::string>() : "";
  if (std::find(length_units.begin(), length_units.end(), unit) != length_units.end()) return unit;
  diagnostics.push_back(
      {"/units/unit", R"(must be "um", "mm", "cm" or "m", is )" + describe(value)});
  return "";
}

}  // namespace

GivenUnits read_units(const Json& file, Diagnostics& diagnostics) {
  const auto found = file.find("units");
  if (found == file.end()) return std::nullopt;
  const bool is_object = found->is_object();
  if (!is_object || !found->contains("d") || !found->contains("unit")) {
    const char* missing = is_object && found->contains("d") ? "unit" : "d";
    diagnostics.push_back(
        {"/units",
         R"(must say how long d is, e.g. { "d": 3.2, "unit": "mm" }, )" +
             (is_object ? "has no \"" + std::string(missing) + "\"" : "is " + describe(*found))});
    return std::nullopt;
  }
  refuse_unknown_keys(*found, "/units", {"d", "unit", "density"}, diagnostics);
  const auto d = number_at("d", found->at("d"), allowed_lengths, "", diagnostics);
  Units units{d.value_or(1.0), unit_at(found->at("unit"), diagnostics), std::nullopt};
  if (const auto density = found->find("density"); density != found->end()) {
    units.density = number_at("density", *density, densities, "of kg/m3 ", diagnostics);
  }
  return units;
}

}  // namespace grainsweep
