// Where a number must lie.
#pragma once

#include <cmath>
#include <string>

#include "engine/text.hpp"
#include "engine/units.hpp"

namespace grainsweep {

struct Interval {
  double low = 0.0;
  double high = infinity;
  bool low_open = false, high_open = false;  ///< whether the bound itself is left out

  bool holds(double value) const {  // false for NaN
    return (low_open ? value > low : value >= low) && (high_open ? value < high : value <= high);
  }

  /// "(0, 2]", "> 0".
  std::string text() const {
    if (std::isinf(high)) return (low_open ? "> " : ">= ") + bound_text(low);
    return (low_open ? "(" : "[") + bound_text(low) + ", " + bound_text(high) +
           (high_open ? ")" : "]");
  }
};

/// The end of a message about a share: what to do if it was given in percent, as one far above the
/// interval.
inline std::string percent_hint(const Interval& shares, double value) {
  return value >= 1.0 && value > 2.0 * shares.high && shares.holds(value / 100.0)
             ? "; divide percentages by 100"
             : "";
}

}  // namespace grainsweep
