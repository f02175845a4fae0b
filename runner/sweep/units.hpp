// What a length of 1 and a density mean in a laboratory: for people only. The engine works without
// units, and no packing depends on what a sweep says about them.
#pragma once

#include <array>
#include <optional>
#include <string>

namespace grainsweep {

inline constexpr std::array length_units = {"um", "mm", "cm", "m"};
inline constexpr double largest_length = 1e6;                             ///< of d, in any of them
inline constexpr double least_density = 10.0, largest_density = 25000.0;  ///< kg/m3, of solids

struct Units {
  double d = 1.0;                 ///< mean diameter of the large grains, in `unit`
  std::string unit;               ///< one of length_units
  std::optional<double> density;  ///< of the grains' solid, kg/m3

  bool operator==(const Units&) const = default;
};

/// What a sweep says of its units, if it does.
using GivenUnits = std::optional<Units>;

}  // namespace grainsweep
