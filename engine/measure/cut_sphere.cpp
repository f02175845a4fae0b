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

/// A plane face of the part beyond three planes: the corner y > b, z > c of a disc.
struct DiscCorner {
  double area;
  double angle;  ///< of its arc, seen from the disc's centre
};

/// The corner lies in the disc; `squared` is the disc's radius squared.
DiscCorner disc_corner(double squared, double b, double c) {
  const double y = std::sqrt(std::max(0.0, squared - c * c));
  const double z = std::sqrt(std::max(0.0, squared - b * b));
  const double angle = std::atan2(z, b) - std::atan2(c, y);
  return {(squared * angle - c * (y - b) - b * (z - c)) / 2.0, angle};
}

/// The part beyond three planes, none of which lies behind the centre.
double front_octant_volume(double radius, double a, double b, double c) {
  const double squared = radius * radius;
  if (a * a + b * b + c * c >= squared) return 0.0;
  const auto turn = [&](double one, double other) {
    return std::atan2(radius * std::sqrt(squared - one * one - other * other), -one * other);
  };
  const DiscCorner on_a = disc_corner(squared - a * a, b, c);
  const DiscCorner on_b = disc_corner(squared - b * b, c, a);
  const DiscCorner on_c = disc_corner(squared - c * c, a, b);
  const double patch = squared * (2.0 * pi - turn(a, b) - turn(b, c) - turn(c, a)) -
                       radius * (a * on_a.angle + b * on_b.angle + c * on_c.angle);
  return (radius * patch - a * on_a.area - b * on_b.area - c * on_c.area) / 3.0;
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

double sphere_octant_volume(double radius, double a, double b, double c) {
  if (a < 0.0) {
    return sphere_corner_volume(radius, b, c) - sphere_octant_volume(radius, -a, b, c);
  }
  if (b < 0.0) {
    return sphere_corner_volume(radius, a, c) - sphere_octant_volume(radius, a, -b, c);
  }
  if (c < 0.0) {
    return sphere_corner_volume(radius, a, b) - sphere_octant_volume(radius, a, b, -c);
  }
  return front_octant_volume(radius, a, b, c);
}

double sphere_box_volume(double radius, const Span& x, const Span& y, const Span& z) {
  double volume = 0.0;
  for (const bool far_x : {false, true}) {
    for (const bool far_y : {false, true}) {
      for (const bool far_z : {false, true}) {
        const double sign = (far_x != far_y) != far_z ? -1.0 : 1.0;
        volume += sign * sphere_octant_volume(radius, far_x ? x.high : x.low,
                                              far_y ? y.high : y.low, far_z ? z.high : z.low);
      }
    }
  }
  return volume;
}

}  // namespace grainsweep
