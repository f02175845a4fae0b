#include "engine/measure/cut_sphere.hpp"

#include <algorithm>
#include <cmath>

#include "engine/measure/solid_fraction.hpp"
#include "engine/units.hpp"

namespace grainsweep {

namespace {

/// The part when the planes' common line passes the ball.
double apart_volume(double radius, double a, double b) {
  const double cap_a = sphere_slab_volume(radius, a, radius);
  const double cap_b = sphere_slab_volume(radius, b, radius);
  if (a >= 0.0) {
    return b >= 0.0 ? 0.0 : cap_a;
  }
  return b >= 0.0 ? cap_b : cap_a + cap_b - sphere_volume(radius);
}

}  // namespace

double sphere_corner_volume(double radius, double a, double b) {
  a = std::clamp(a, -radius, radius);
  b = std::clamp(b, -radius, radius);
  const double squared = radius * radius, edge = squared - a * a - b * b;
  if (edge <= 0.0) {
    return apart_volume(radius, a, b);
  }
  const double s = std::sqrt(edge);
  const double disc_a = a * (squared - a * a / 3.0), disc_b = b * (squared - b * b / 3.0);
  return 2.0 / 3.0 * (radius * squared * std::atan2(radius * s, a * b) + a * b * s) -
         disc_a * std::atan2(s, b) - disc_b * std::atan2(s, a);
}

double sphere_beam_volume(double radius, double top_y, double low_z, double high_z) {
  const auto below = [&](double z) {  // the part with y < top_y and z below the plane
    return sphere_corner_volume(radius, -top_y, -z);
  };
  return below(high_z) - below(low_z);
}

}  // namespace grainsweep
