#include "engine/scene/shape_bed.hpp"

#include <cmath>
#include <utility>

namespace grainsweep {

namespace {

/// sin(x) / x and cos(x) of x = sqrt(squared) by their series: the same bits with any mathematical
/// library. Exact to rounding for x <= 1; beyond, the quaternion is still a turn about its axis.
struct SineCosine {
  double sine_over, cosine;
};
SineCosine series(double squared) {
  constexpr int terms = 10;
  SineCosine sum{1.0, 1.0};
  for (int k = terms; k > 0; --k) {
    sum.sine_over = 1.0 - squared * sum.sine_over / (2.0 * k * (2.0 * k + 1.0));
    sum.cosine = 1.0 - squared * sum.cosine / (2.0 * k * (2.0 * k - 1.0));
  }
  return sum;
}

/// The turn by an angle vector, radians.
Quaternion turn_by(const Vector& angles) {
  const SineCosine half = series(angles.squaredNorm() / 4.0);
  const Vector axis = half.sine_over / 2.0 * angles;
  return Quaternion(half.cosine, axis.x(), axis.y(), axis.z()).normalized();
}

Record<double> record_of(const Quaternion& q) { return {q.x(), q.y(), q.z(), q.w()}; }

}  // namespace

ShapeBed make_shape_bed(const Box& box, ConvexShape shape, const std::vector<Pose>& poses) {
  ShapeBed bed{box, walls_of(box), std::move(shape), {}, {}, {}, {}, {}};
  for (const Pose& p : poses) {
    bed.centre.push_back({p.centre.x(), p.centre.y(), p.centre.z(), p.scale});
    bed.orientation.push_back(record_of(p.orientation));
    bed.motion.push_back({0.0, 0.0, 0.0, 1.0 / (p.scale * p.scale * p.scale)});
    bed.root_inertia.emplace_back(p.scale * (bed.shape.inertia / bed.motion.back().w).cwiseSqrt());
  }
  bed.turn.assign(poses.size(), Vector::Zero());
  return bed;
}

bool is_finite(const ShapeBed& bed) {
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    if (!is_finite(bed.centre[i]) || !is_finite(bed.orientation[i]) || !is_finite(bed.motion[i]) ||
        !bed.turn[i].allFinite()) {
      return false;
    }
  }
  return true;
}

Vector nearest_difference(const ShapeBed& bed, std::size_t a, std::size_t b) {
  const Record<double>&p = bed.centre[a], &q = bed.centre[b];
  return {nearest_image(q.x - p.x, bed.box.period_x()),
          nearest_image(q.y - p.y, bed.box.period_y()), q.z - p.z};
}

PairPose pair_pose(const ShapeBed& bed, std::size_t a, std::size_t b) {
  return seen_from_a(bed.pose(a), bed.pose(b), nearest_difference(bed, a, b));
}

void set_balls(const ShapeBed& bed, double radius, SphereBed& balls) {
  if (balls.position.empty() || balls.grains() != bed.grains()) {
    balls = make_bed(bed.box, std::vector<PlacedSphere>(bed.grains()));
  }
  balls.box = bed.box;
  balls.walls = bed.walls;
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    const Record<double>& p = bed.centre[i];
    balls.position[i] = {p.x, p.y, p.z, p.w * radius};
  }
}

void wrap(ShapeBed& bed) {
  for (Record<double>& p : bed.centre) wrap(bed.box, p);
}

void move_grain(ShapeBed& bed, std::size_t grain, const Vector& displacement,
                const Vector& angles) {
  Record<double>&centre = bed.centre[grain], &motion = bed.motion[grain];
  centre = {centre.x + displacement.x(), centre.y + displacement.y(), centre.z + displacement.z(),
            centre.w};
  motion = {displacement.x(), displacement.y(), displacement.z(), motion.w};
  const Quaternion step = turn_by(angles);
  bed.orientation[grain] = record_of((bed.pose(grain).orientation * step).normalized());
  const Vector momentum = step.conjugate() * bed.shape.inertia.cwiseProduct(angles);
  bed.turn[grain] = momentum.cwiseQuotient(bed.shape.inertia);
}

std::uint64_t state_hash(const ShapeBed& bed) {
  std::uint64_t hash = bed.grains();
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    hash = mixed(mixed(hash, bed.centre[i]), bed.orientation[i]);
  }
  return hash;
}

}  // namespace grainsweep
