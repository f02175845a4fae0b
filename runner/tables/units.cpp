#include "runner/tables/units.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string_view>

#include "engine/text.hpp"
#include "runner/sweep/parameters.hpp"
#include "runner/tables/csv.hpp"
#include "runner/text.hpp"

namespace grainsweep {

std::vector<Conversion> conversions_of(const std::string& name, const std::string& unit,
                                       const Units& units) {
  if (find_parameter(name)) return {};  // it is as the sweep has it
  if (unit == "d") return {{name + "_" + units.unit, units.unit, "", 0.0, units.d}};
  constexpr std::string_view solid_fraction = "solid_fraction";
  if (name.rfind(solid_fraction, 0) != 0) return {};
  const std::string part = name.substr(solid_fraction.size());
  const bool is_scatter = part == "_sd" || part == "_error";
  if (!part.empty() && !is_scatter) return {};
  std::vector<Conversion> to = {{"porosity" + part, "", "1 - solid fraction", 1.0, -1.0}};
  if (is_scatter) to = {{"porosity" + part, "", "", 0.0, 1.0}};
  if (units.density) {
    const char* const meaning = is_scatter ? "" : "mass of the grains over the volume they fill";
    to.push_back({"bulk_density" + part, "kg/m3", meaning, 0.0, *units.density});
  }
  return to;
}

std::string converted(const std::string& text, const Conversion& to) {
  constexpr std::size_t short_number = 15;
  if (text.empty()) return "";
  const double value =
      to.offset + to.factor * std::strtod(text.c_str(), nullptr);  // stod throws on 1e-310
  return text.size() <= short_number ? short_cell(value, 15) : cell(value);
}

std::string printed_unit(const Units& units) { return units.unit == "um" ? "µm" : units.unit; }

std::string units_text(const Units& units) {
  const std::string length = "d = " + cell(units.d) + " " + printed_unit(units);
  return units.density ? length + ", grains of " + cell(*units.density) + " kg/m³" : length;
}

std::string length_in(const Units& units, double length) {
  return number_text(units.d * length, 6);  // the product of two short numbers is short
}

std::string length_text(double length, double error, int decimals, const GivenUnits& units) {
  std::string text = with_error(length, error, decimals) + " d";
  if (!units) return text;
  return text + " = " +
         with_error(units->d * length, units->d * error, decimals_in(*units, decimals)) + " " +
         printed_unit(*units);
}

int decimals_in(const Units& units, int decimals) {
  return std::max(0, decimals - static_cast<int>(std::floor(std::log10(units.d))));
}

std::string bulk_density_text(const Units& units, double solid_fraction, double error) {
  if (!units.density) return "-";
  return with_error(*units.density * solid_fraction, *units.density * error, 0);
}

}  // namespace grainsweep
