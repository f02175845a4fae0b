#include "engine/scene/box.hpp"

#include <cmath>

namespace grainsweep {

namespace {

double wrapped(double coordinate, double period) {
  const double inside = coordinate - period * std::floor(coordinate / period);
  return inside < period ? inside : 0.0;
}

}  // namespace

Box tube_of(double diameter) {
  return {diameter, diameter, Boundary::walls, Boundary::walls, true};
}

UnitVector Wall::normal(double x, double y, double /*z*/) const {
  if (!is_round()) return inward;
  const double to_x = radius - x, to_y = radius - y,
               distance = std::sqrt(to_x * to_x + to_y * to_y);
  return distance > 0.0 ? UnitVector{to_x / distance, to_y / distance, 0.0}
                        : UnitVector{1.0, 0.0, 0.0};
}

void wrap(const Box& box, Record<double>& centre) {
  centre.x = box.x == Boundary::periodic ? wrapped(centre.x, box.length) : centre.x;
  centre.y = box.y == Boundary::periodic ? wrapped(centre.y, box.width) : centre.y;
}

std::vector<Wall> walls_of(const Box& box) {
  std::vector<Wall> walls = {{{0.0, 0.0, 1.0}, 0.0}};
  if (box.is_tube) {
    walls.push_back({{}, 0.0, box.length / 2.0});
    return walls;
  }
  if (box.x == Boundary::walls) {
    walls.insert(walls.end(), {{{1.0, 0.0, 0.0}, 0.0}, {{-1.0, 0.0, 0.0}, box.length}});
  }
  if (box.y == Boundary::walls) {
    walls.insert(walls.end(), {{{0.0, 1.0, 0.0}, 0.0}, {{0.0, -1.0, 0.0}, box.width}});
  }
  return walls;
}

}  // namespace grainsweep
