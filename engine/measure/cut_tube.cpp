#include "engine/measure/cut_tube.hpp"

#include <algorithm>
#include <cmath>

#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/quadrature/gauss_kronrod.hpp>

#include "engine/units.hpp"

namespace grainsweep {

namespace {

/// x - sin x without the loss of digits near 0.
double minus_sine(double x) {
  if (x > 0.5) return x - std::sin(x);
  const double squared = x * x;
  double term = x * squared / 6.0, sum = term;
  for (double k = 4.0; k < 20.0; k += 2.0) {
    term *= -squared / (k * (k + 1.0));
    sum += term;
  }
  return sum;
}

/// Area of the segment of a disc whose chord is seen under the angle 2 `half_angle`.
double segment_area(double radius, double half_angle) {
  return 0.5 * radius * radius * minus_sine(2.0 * half_angle);
}

/// Volume of a ball about the origin between two heights that lie in it, d^3.
double layer_volume(double radius, double low, double high) {
  const double squared = radius * radius;
  return pi * (high - low) * (squared - (low * low + low * high + high * high) / 3.0);
}

/// Integral of what the discs of a ball and of a cylinder share, from one height to another,
/// between which no disc holds the other. Where their rims nearly touch all the way round, Gauss's
/// rule alone would lose half the digits.
double crossing_volume(double radius, double distance, double tube, double low, double high) {
  if (high <= low) return 0.0;
  const double middle = 0.5 * (low + high), half = 0.5 * (high - low);
  const auto shared = [&](double t) {
    const double z = middle - half * std::cos(t);
    const double disc = std::sqrt(std::max(0.0, (radius - z) * (radius + z)));
    return shared_area(disc, tube, distance) * half * std::sin(t);
  };
  using boost::math::quadrature::gauss, boost::math::quadrature::gauss_kronrod;
  constexpr unsigned most_halvings = 8;
  return std::abs(tube - distance) > 0.1 * radius
             ? gauss<double, 30>::integrate(shared, 0.0, pi)
             : gauss_kronrod<double, 31>::integrate(shared, 0.0, pi, most_halvings, 1e-13);
}

}  // namespace

double shared_area(double radius, double other_radius, double distance) {
  const double a = std::min(radius, other_radius), b = std::max(radius, other_radius);
  if (distance >= a + b) return 0.0;
  if (distance <= b - a) return pi * a * a;
  // Sixteen times the squared area of the triangle between the centres and a crossing of the rims.
  const double squared =
      (a + b + distance) * (a + b - distance) * (distance + (b - a)) * (distance - (b - a));
  const double chord = std::sqrt(std::max(0.0, squared));
  const double gap = distance - b;  // keeps its digits beside a large disc
  const double at_a = std::atan2(chord, gap * (distance + b) + a * a);
  const double at_b = std::atan2(chord, (b - a) * (b + a) + distance * distance);
  return segment_area(a, at_a) + segment_area(b, at_b);
}

double sphere_tube_volume(double radius, double distance, double tube, double low, double high) {
  const double bottom = std::clamp(low, -radius, radius), top = std::clamp(high, -radius, radius);
  if (bottom >= top || tube <= 0.0 || distance - tube >= radius) return 0.0;
  tube = std::min(tube, distance + radius);  // a wider one holds as much
  // The height above the centre at which the ball's disc has a radius; 0 if none is so large.
  const auto height_of = [&](double disc) {
    return disc < radius ? std::sqrt((radius - disc) * (radius + disc)) : 0.0;
  };
  const auto within = [&](double z) { return std::clamp(z, bottom, top); };
  const double holds = height_of(tube + distance);              // below it discs hold the tube's,
  const double crosses = height_of(std::abs(tube - distance));  // below it they cross its rim
  const double whole = pi * tube * tube * (within(holds) - within(-holds));
  const double crossing = crossing_volume(radius, distance, tube, within(holds), within(crosses)) +
                          crossing_volume(radius, distance, tube, within(-crosses), within(-holds));
  if (distance >= tube) return whole + crossing;
  return whole + crossing + layer_volume(radius, within(crosses), top) +
         layer_volume(radius, bottom, within(-crosses));
}

}  // namespace grainsweep
