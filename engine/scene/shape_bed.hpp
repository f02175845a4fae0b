// A bed of grains of one convex shape: the state that a packing carries from step to step.
//
// Grains that turn carry an orientation and an angle vector besides what spheres carry. The mass of
// a grain of scale s is s^3 (that of a grain of scale 1 is the unit), its principal moments are
// s^5 times `shape.inertia`.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/scene/bed.hpp"
#include "engine/shape/pose.hpp"

namespace grainsweep {

/// Columns of a bed, an entry per grain.
struct ShapeBed {
  Box box;
  std::vector<Wall> walls;  ///< of the box, the floor first
  ConvexShape shape;
  std::vector<Record<double>> centre;  ///< x, y, z and scale, d; x and y may leave the box
  std::vector<Record<double>>
      orientation;                     ///< unit quaternion x, y, z, w: shape frame to box frame
  std::vector<Record<double>> motion;  ///< displacement of the last step, d, and inverse mass
  std::vector<Vector>
      turn;  ///< angle vector of the next step if nothing acts, grain frame, radians
  std::vector<Vector> root_inertia;  ///< square roots of the principal moments, sqrt(m) d

  std::size_t grains() const { return centre.size(); }
  // Entries after the grains, where rows name what is no grain: the floor and the walls, in the
  // order of walls_of(box), and two void grains that fill unused lanes.
  static constexpr std::size_t most_walls = 5;
  std::int32_t wall(std::size_t k) const { return static_cast<std::int32_t>(grains() + k); }
  std::int32_t void_a() const { return wall(most_walls); }
  std::int32_t void_b() const { return void_a() + 1; }
  bool is_grain(std::int32_t entry) const { return entry < wall(0); }
  std::size_t entries() const { return grains() + most_walls + 2; }

  Pose pose(std::size_t grain) const { return pose_of(centre[grain], orientation[grain]); }
  double circumradius(std::size_t grain) const { return centre[grain].w * shape.circumradius; }
};

/// A bed at rest in mid-air. Requires unit quaternions and positive scales.
ShapeBed make_shape_bed(const Box& box, ConvexShape shape, const std::vector<Pose>& poses);

/// Whether every grain's place, scale, orientation, motion and inverse mass is a finite number.
bool is_finite(const ShapeBed& bed);

/// Centre of grain b minus that of grain a, of the nearest image, box frame, d.
Vector nearest_difference(const ShapeBed& bed, std::size_t a, std::size_t b);

/// Grain b, of its nearest image, as grain a sees it.
PairPose pair_pose(const ShapeBed& bed, std::size_t a, std::size_t b);

/// Balls at the centres, as large as a ball of `radius` about the shape becomes with the grain, d.
void set_balls(const ShapeBed& bed, double radius, SphereBed& balls);

/// Brings x and y of every grain back into the box along periodic axes.
void wrap(ShapeBed& bed);

/// Moves a grain by `displacement` (d, box frame) and turns it by the angle vector `angles`
/// (radians, grain frame), exactly; both become its motion. The angle vector is carried on so that
/// a free grain keeps its angular momentum.
void move_grain(ShapeBed& bed, std::size_t grain, const Vector& displacement, const Vector& angles);

/// Hash of all centres and orientations, bit by bit.
std::uint64_t state_hash(const ShapeBed& bed);

}  // namespace grainsweep
