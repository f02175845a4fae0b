#include "engine/shape/pinacoid.hpp"

#include <cmath>

#include "engine/portable.hpp"
#include "engine/shape/build.hpp"
#include "engine/shape/lengths.hpp"
#include "engine/text.hpp"
#include "engine/units.hpp"

namespace grainsweep {

namespace {

constexpr double degree = pi / 180.0;

// A ridge shorter than this share of the length is rounding of a point.
constexpr double no_ridge = 1e-12;

PinacoidHalves halves_of(const PinacoidSize& size) {
  const double a = size.length / 2.0, e = size.height / 2.0;
  const double c = a - e / portable::tan(size.angle);
  return {a, size.width / 2.0, c > no_ridge * a ? c : 0.0, e};
}

std::vector<Vector> vertices_of(const PinacoidHalves& w) {
  return {{w.a, w.b, 0}, {-w.a, w.b, 0}, {-w.a, -w.b, 0}, {w.a, -w.b, 0},
          {w.c, 0, w.e}, {-w.c, 0, w.e}, {w.c, 0, -w.e},  {-w.c, 0, -w.e}};
}

/// Two roofs and two ends above, then the faces opposite to them in the same order.
Loops loops_of_ridges() {
  return {{0, 1, 5, 4}, {2, 3, 4, 5}, {0, 4, 3}, {2, 5, 1},
          {7, 6, 3, 2}, {6, 7, 1, 0}, {1, 7, 2}, {3, 6, 0}};
}
/// The same where each ridge is a point.
Loops loops_of_points() {
  return {{0, 1, 4}, {2, 3, 4}, {0, 4, 3}, {2, 4, 1}, {5, 3, 2}, {5, 1, 0}, {1, 5, 2}, {3, 5, 0}};
}

/// Sections at height t e are rectangles of half lengths a - s t and b (1 - t).
void set_mass(const PinacoidHalves& w, ConvexShape& shape) {
  const double a = w.a, s = w.a - w.c, e_b = 8.0 * w.e * w.b;
  const double volume = e_b * (a / 2.0 - s / 6.0);
  const double cubes = a * a * a / 2.0 - a * a * s / 2.0 + a * s * s / 4.0 - s * s * s / 20.0;
  const double xx = e_b / 3.0 * cubes / volume;
  const double yy = e_b / 3.0 * w.b * w.b * (a / 4.0 - s / 20.0) / volume;
  const double zz = e_b * w.e * w.e * (a / 12.0 - s / 20.0) / volume;
  shape.volume = volume;
  shape.inertia = {yy + zz, xx + zz, xx + yy};
}

std::string problem_with_angle(const PinacoidSize& size) {
  constexpr double steepest = 89.0;  // degrees
  const double degrees = size.angle / degree;
  if (!(size.angle > 0.0) || !(degrees <= steepest)) {
    return joined("angle must be above 0 and at most ", steepest, " degrees, is ", degrees,
                  "; upright ends are the shape of a hull");
  }
  // The same rounding as the width: a ridge of no length is allowed.
  const double steepness = portable::tan(size.angle) * size.length;
  if (steepness >= size.height * (1.0 - no_ridge)) return "";
  const double least = std::ceil(portable::atan(size.height / size.length) / degree * 1e4) / 1e4;
  const std::string fault =
      joined("the ends would cross: tan(angle) must be at least height / length = ",
             size.height / size.length, ", is ", portable::tan(size.angle));
  if (least > steepest) return fault + "; no angle is that steep: make it longer, or less high";
  return fault + joined("; the least angle is ", least, " degrees");
}

}  // namespace

std::string problem_with(const PinacoidSize& size) {
  const std::string problem = problem_with_lengths(
      {{"length", size.length}, {"width", size.width}, {"height", size.height}});
  return problem.empty() ? problem_with_angle(size) : problem;
}

ConvexShape pinacoid(const PinacoidSize& size) {
  const PinacoidHalves width = halves_of(size);
  std::vector<Vector> vertices = vertices_of(width);
  if (width.c == 0.0) {
    vertices.erase(vertices.begin() + 7);
    vertices.erase(vertices.begin() + 5);
  }
  ConvexShape shape =
      build_shape(std::move(vertices), width.c == 0.0 ? loops_of_points() : loops_of_ridges());
  set_mass(width, shape);
  shape.pinacoid = width;
  return shape;
}

}  // namespace grainsweep
