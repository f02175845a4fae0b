// What people ask for of the means of a group.
#pragma once

namespace grainsweep {

/// Largest error of the means that is asked for; 0: none is.
struct ErrorWish {
  double solid_fraction = 0.0;
  double coordination = 0.0;

  bool is_given() const { return solid_fraction > 0.0 || coordination > 0.0; }
};

}  // namespace grainsweep
