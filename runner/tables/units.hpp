// Lengths in the unit of a sweep, porosity and bulk density: columns beside those in d.
#pragma once

#include <string>
#include <vector>

#include "runner/sweep/units.hpp"
#include "runner/tables/columns.hpp"

namespace grainsweep {

/// A column that follows from another: offset + factor times its value.
struct Conversion {
  std::string name, unit;
  std::string meaning;  ///< empty: that of the other column
  double offset = 0.0, factor = 1.0;
};

/// What a column of this name and unit is converted to: a length to the unit of the sweep, a solid
/// fraction to porosity and, where the density of the grains is known, to bulk density, their
/// scatter and errors likewise; nothing else is.
std::vector<Conversion> conversions_of(const std::string& name, const std::string& unit,
                                       const Units& units);

/// A cell converted; empty where it is. Of a short number, as where a bin begins, it is a short
/// one.
std::string converted(const std::string& text, const Conversion& to);

/// "µm" of "um", the others as they are.
std::string printed_unit(const Units& units);

/// "d = 3.2 mm, grains of 2500 kg/m³"
std::string units_text(const Units& units);

/// A length in d as people read it: "16", of 5 d of 3.2 mm.
std::string length_in(const Units& units, double length);

/// "0.42 ± 0.03 d", and with units " = 1.34 ± 0.10 mm"; without an error the value alone.
std::string length_text(double length, double error, int decimals, const GivenUnits& units);

/// Decimals that are as fine in `units` as `decimals` of a length in d.
int decimals_in(const Units& units, int decimals);

/// "1523 ± 3" kg/m³ of a solid fraction and its scatter or error; "-" where no density is given.
std::string bulk_density_text(const Units& units, double solid_fraction, double error);

/// Appends to the columns of a table what they are converted to.
template <class Item>
void append_in_units(Columns<Item>& columns, const GivenUnits& units) {
  if (!units) return;
  Columns<Item> more;
  for (const Column<Item>& column : columns) {
    for (const Conversion& to : conversions_of(column.name, column.unit, *units)) {
      const std::string& meaning = to.meaning.empty() ? column.meaning : to.meaning;
      more.push_back({to.name, to.unit, meaning, [cell = column.cell, to](const Item& item) {
                        return converted(cell(item), to);
                      }});
    }
  }
  columns.insert(columns.end(), more.begin(), more.end());
}

/// The same for a component of a mixture, without porosity: what others fill is no pore.
template <class Item>
void append_in_units_of_component(Columns<Item>& columns, const GivenUnits& units) {
  append_in_units(columns, units);
  std::erase_if(columns,
                [](const Column<Item>& column) { return column.name.starts_with("porosity"); });
}

}  // namespace grainsweep
