#include "engine/shape/named_shapes.hpp"

#include <algorithm>
#include <cmath>

#include "engine/portable.hpp"
#include "engine/shape/lengths.hpp"
#include "engine/text.hpp"
#include "engine/units.hpp"

namespace grainsweep {

namespace {

const double root_3 = std::sqrt(3.0);
const double golden_ratio = (1.0 + std::sqrt(5.0)) / 2.0;

/// (+-x, +-y, +-z).
std::vector<Vector> corners_of_brick(double x, double y, double z) {
  std::vector<Vector> corners;
  for (const double p : {-x, x}) {
    for (const double q : {-y, y}) {
      for (const double r : {-z, z}) corners.emplace_back(p, q, r);
    }
  }
  return corners;
}

/// (0, +-y, +-z), (+-y, +-z, 0) and (+-z, 0, +-y).
void add_three_rectangles(double y, double z, std::vector<Vector>& corners) {
  for (const double p : {-y, y}) {
    for (const double q : {-z, z}) {
      corners.insert(corners.end(), {{0.0, p, q}, {p, q, 0.0}, {q, 0.0, p}});
    }
  }
}

}  // namespace

int sides_of(const CylinderSize& size) {
  const double cosine = 1.0 - 2.0 * size.chord_error / size.diameter;
  const double sides = std::ceil(pi / portable::acos(std::max(cosine, -1.0)));
  return static_cast<int>(std::clamp(sides, 3.0, most_sides + 1.0));
}

std::string problem_with(const CubeSize& size) { return problem_with_length("edge", size.edge); }

std::string problem_with(const CuboidSize& size) {
  return problem_with_lengths(
      {{"length", size.length}, {"width", size.width}, {"height", size.height}});
}

std::string problem_with(const PrismSize& size) {
  if (size.sides < 3 || size.sides > most_sides) {
    return joined("sides must be 3 to ", most_sides, ", is ", size.sides);
  }
  return problem_with_lengths({{"height", size.height}, {"diameter", size.diameter}});
}

std::string problem_with(const CylinderSize& size) {
  std::string problem = problem_with_lengths(
      {{"height", size.height}, {"diameter", size.diameter}, {"chord_error", size.chord_error}});
  if (!problem.empty() || sides_of(size) <= most_sides) return problem;
  constexpr double printed_up = 1.00001;  // six digits of the least may lie below it
  return joined("chord_error must be at least ",
                printed_up * size.diameter / 2.0 * (1.0 - portable::cos(pi / most_sides)),
                ", for which the diameter of ", size.diameter, " d takes ", most_sides,
                " sides, is ", size.chord_error);
}

std::vector<Vector> corners_of(const CubeSize& size) {
  const double half = size.edge / 2.0;
  return corners_of_brick(half, half, half);
}

std::vector<Vector> corners_of(const CuboidSize& size) {
  return corners_of_brick(size.length / 2.0, size.width / 2.0, size.height / 2.0);
}

/// Every other corner of a cube of edge 2 a, 4 a / sqrt 3 high.
std::vector<Vector> corners_of(const TetrahedronSize& size) {
  const double a = size.height * root_3 / 4.0;
  return {{a, a, a}, {a, -a, -a}, {-a, a, -a}, {-a, -a, a}};
}

/// Corners a from the middle; 2 a / sqrt 3 high.
std::vector<Vector> corners_of(const OctahedronSize& size) {
  const double a = size.height * root_3 / 2.0;
  return {{a, 0, 0}, {-a, 0, 0}, {0, a, 0}, {0, -a, 0}, {0, 0, a}, {0, 0, -a}};
}

/// Those of a cube of edge 2 a and three rectangles; normals of faces along (0, 1, golden ratio).
std::vector<Vector> corners_of(const DodecahedronSize& size) {
  const double g = golden_ratio, a = size.height / 2.0 * std::sqrt(1.0 + g * g) / (g * g);
  std::vector<Vector> corners = corners_of_brick(a, a, a);
  add_three_rectangles(a / g, a * g, corners);
  return corners;
}

/// Three rectangles of edge 2 a; a face has the normal (1, 1, 1).
std::vector<Vector> corners_of(const IcosahedronSize& size) {
  const double g = golden_ratio, a = size.height / 2.0 * root_3 / (g * g);
  std::vector<Vector> corners;
  add_three_rectangles(a, a * g, corners);
  return corners;
}

std::vector<Vector> corners_of(const PrismSize& size) {
  std::vector<Vector> corners;
  for (int k = 0; k < size.sides; ++k) {
    const double angle = 2.0 * pi * k / size.sides, radius = size.diameter / 2.0;
    const double x = radius * portable::cos(angle), y = radius * portable::sin(angle);
    for (const double z : {-size.height / 2.0, size.height / 2.0}) corners.emplace_back(x, y, z);
  }
  return corners;
}

std::vector<Vector> corners_of(const CylinderSize& size) {
  return corners_of(PrismSize{sides_of(size), size.height, size.diameter});
}

}  // namespace grainsweep
