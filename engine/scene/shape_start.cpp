#include "engine/scene/shape_start.hpp"

#include <cmath>
#include <cstdint>
#include <variant>
#include <vector>

#include "engine/scene/random.hpp"
#include "engine/scene/sizes.hpp"
#include "engine/scene/start.hpp"
#include "engine/shape/given_shape.hpp"
#include "engine/units.hpp"

namespace grainsweep {

namespace {

/// A point in the unit disc, uniform.
struct DiscPoint {
  double x, y, squared;
};
DiscPoint disc_point(std::uint32_t a, std::uint32_t b) {
  const double x = 2.0 * unit_interval(a) - 1.0, y = 2.0 * unit_interval(b) - 1.0;
  return {x, y, x * x + y * y};
}

/// Uniform over all rotations, from two points in the unit disc (Marsaglia 1972).
Quaternion random_orientation(std::uint64_t key, std::uint64_t grain) {
  for (std::uint32_t attempt = 0;; ++attempt) {
    const auto words = random_words(key, Purpose::turn, grain, attempt);
    const DiscPoint p = disc_point(words[0], words[1]), q = disc_point(words[2], words[3]);
    if (p.squared < 1.0 && q.squared < 1.0) {
      const double share = std::sqrt((1.0 - p.squared) / q.squared);
      return Quaternion(p.x, p.y, share * q.x, share * q.y).normalized();
    }
  }
}

double column_height(const Box& box, const std::vector<double>& radii, double volume) {
  double solid = 0.0;
  for (const double radius : radii) solid += volume * sphere_mass(radius);
  return solid / (shape_start_solid_fraction * box.length * box.width);
}

/// The poses of placed grains, whose orientations are those of the shape as it is written.
std::vector<Pose> placed_poses(const PlacedGrains& placed, const GivenFrame& given) {
  const Quaternion rotation(given.rotation);
  std::vector<Pose> poses;
  for (std::size_t i = 0; i < placed.grains.size(); ++i) {
    const PlacedSphere& grain = placed.grains[i];
    const auto& [x, y, z, w] = placed.orientations[i];
    const Quaternion turn(w, x, y, z);
    poses.push_back(
        {{grain.x, grain.y, grain.z}, 2.0 * grain.radius, (turn * rotation).normalized()});
  }
  return poses;
}

}  // namespace

std::optional<ShapeBed> start_shapes(const PackingSpec& spec) {
  const ConvexShape shape = *shape_of(spec.shape).shape;
  const Box& box = spec.box;
  if (const auto* placed = std::get_if<PlacedGrains>(&spec.fill)) {
    return make_shape_bed(box, shape, placed_poses(*placed, shape.given));
  }
  std::vector<double> radii = draw_radii(spec);
  if (radii.empty()) return make_shape_bed(box, shape, {});
  const double height = column_height(box, radii, shape.volume);
  const double ball = start_ball * std::cbrt(shape.volume / sphere_volume(1.0));
  for (double& radius : radii) radius *= 2.0 * ball;
  const auto balls = place_at_random(box, radii, height, spec.random_key);
  if (!balls) return std::nullopt;
  std::vector<Pose> poses;
  for (const PlacedSphere& s : *balls) {
    poses.push_back(
        {{s.x, s.y, s.z}, s.radius / ball, random_orientation(spec.random_key, poses.size())});
  }
  return make_shape_bed(box, shape, poses);
}

}  // namespace grainsweep
