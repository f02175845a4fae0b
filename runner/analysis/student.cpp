#include "runner/analysis/student.hpp"

#include <array>
#include <cstddef>

namespace grainsweep {
namespace {

/// For 1, 2, ... degrees of freedom, where the series falls short: for 1 by 1.4.
constexpr std::array few = {12.7062047361747, 4.30265272974946, 3.18244630528371,
                            2.77644510519779, 2.57058183563631, 2.44691185114498,
                            2.36462425159278, 2.30600413520417, 2.26215716279820};

/// From the quantile of the normal distribution (Abramowitz and Stegun 26.7.5).
double series(double degrees_of_freedom) {
  constexpr double x = normal_quantile, x2 = x * x;
  constexpr std::array terms = {
      x * (x2 + 1.0) / 4.0, x * ((5.0 * x2 + 16.0) * x2 + 3.0) / 96.0,
      x * (((3.0 * x2 + 19.0) * x2 + 17.0) * x2 - 15.0) / 384.0,
      x * ((((79.0 * x2 + 776.0) * x2 + 1482.0) * x2 - 1920.0) * x2 - 945.0) / 92160.0};
  double quantile = x, power = 1.0;
  for (const double term : terms) quantile += term / (power *= degrees_of_freedom);
  return quantile;
}

}  // namespace

double student_quantile(int degrees_of_freedom) {
  const auto place = static_cast<std::size_t>(degrees_of_freedom) - 1;
  return place < few.size() ? few[place] : series(degrees_of_freedom);
}

}  // namespace grainsweep
