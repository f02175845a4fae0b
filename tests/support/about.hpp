// What a number has to be near.
#pragma once

#include <catch2/catch.hpp>

namespace grainsweep {

/// Equal to whatever differs from `value` by no more than `margin`. Catch2's own margin lets a
/// relative error of 1.2e-5 pass beside it.
inline Approx about(double value, double margin) {
  return Approx(value).margin(margin).epsilon(0.0);
}

}  // namespace grainsweep
