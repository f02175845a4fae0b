// The container: what bounds it, where its walls are, and its periodic images.
//
// A wall is known by the gap and the normal that it has at a point, whatever its form; only code
// for round walls alone asks for more. Volumes, profiles and starts know that a box is a block or a
// cylinder.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/units.hpp"
#include "kernels/row_kernels.hpp"

namespace grainsweep {

/// What bounds a horizontal axis of the box: two fixed flat walls, or its own periodic image.
enum class Boundary { periodic, walls };

/// The box: floor at z = 0, open above. x runs over [0, length], y over [0, width].
///
/// Or an upright round tube that the box's four sides touch: length and width are its diameter, and
/// x and y have no images.
struct Box {
  double length = 20.0;  ///< extent along x, d
  double width = 10.0;   ///< extent along y, d; the gap W between the walls when y is walled
  Boundary x = Boundary::periodic;
  Boundary y = Boundary::walls;
  bool is_tube = false;

  /// Area of the floor, d^2.
  double floor_area() const { return (is_tube ? pi / 4.0 : 1.0) * length * width; }

  /// Period of an axis, d; 0 where it is walled.
  double period_x() const { return x == Boundary::periodic ? length : 0.0; }
  double period_y() const { return y == Boundary::periodic ? width : 0.0; }
};

/// The shorter of its periods, d; infinite if it has none.
inline double shortest_period(const Box& box) {
  const auto of = [](double period) { return period > 0.0 ? period : infinity; };
  return std::min(of(box.period_x()), of(box.period_y()));
}

/// Least distance between walls that face each other, d; infinite where none do.
inline double nearest_walls(const Box& box) {
  const auto of = [](Boundary boundary, double extent) {
    return boundary == Boundary::walls ? extent : infinity;
  };
  return std::min(of(box.x, box.length), of(box.y, box.width));
}

/// Whether walls stand on all sides, as those of a duct and a tube do.
inline bool is_walled_around(const Box& box) {
  return box.x == Boundary::walls && box.y == Boundary::walls;
}

/// The difference between two coordinates, for their nearest images along an axis of that period,
/// d; unchanged if the period is 0. Requires a difference of less than one and a half periods.
inline double nearest_image(double difference, double period) {
  const double half = 0.5 * period;
  if (!(period > 0.0)) return difference;
  return difference > half    ? difference - period
         : difference < -half ? difference + period
                              : difference;
}

/// The tube of that diameter, d.
Box tube_of(double diameter);

/// Brings x and y of a centre back into the box along periodic axes.
void wrap(const Box& box, Record<double>& centre);

/// A direction in the box's frame, of length 1.
struct UnitVector {
  double x = 0.0, y = 0.0, z = 1.0;
};

/// A wall that is flat, or round and upright, seen from within: the points of the free space have a
/// positive distance.
struct Wall {
  UnitVector inward;    ///< of a flat wall, into the free space
  double offset = 0.0;  ///< of a flat wall: distance of the box's origin from it, d
  double radius = 0.0;  ///< of a round wall, d; 0: flat. Its axis stands at x = y = radius

  bool is_round() const { return radius > 0.0; }
  /// Distance of a point from the wall, d; negative beyond it.
  double distance(double x, double y, double z) const {
    const double from_x = x - radius, from_y = y - radius;
    return is_round() ? radius - std::sqrt(from_x * from_x + from_y * from_y)
                      : inward.x * x + inward.y * y + inward.z * z + offset;
  }
  /// Distance of a sphere's surface from the wall, d; negative = overlap. `sphere`: centre, radius.
  double gap(const Record<double>& sphere) const {
    return distance(sphere.x, sphere.y, sphere.z) - sphere.w;
  }
  /// From the wall into the free space, at the point of the wall that is nearest to x, y, z; for a
  /// point on the axis of a round wall, which has no nearest one, towards x.
  UnitVector normal(double x, double y, double z) const;
};

/// All walls of a box, or of a tube: the floor first.
std::vector<Wall> walls_of(const Box& box);

}  // namespace grainsweep
