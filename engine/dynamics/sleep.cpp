#include "engine/dynamics/sleep.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/units.hpp"

namespace grainsweep {

namespace {

constexpr double least_size_ratio =
    0.4;  // grains below half of it slip through triples of large ones

/// Mean speed downwards above which the grains of a slice fall, sqrt(g d): that of a grain that has
/// fallen 0.06 d. Grains that only settle are several times slower, those in the air faster.
constexpr double falling_speed = 0.35;

/// The grains of a slice 1 d high.
struct Slice {
  double mass = 0.0, descent = 0.0;  ///< m, and its sum of m times motion downwards, m d
};

std::vector<Slice> slices_of(const Grains& bed) {
  std::vector<Slice> slices;
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    if (bed.is_asleep(i)) continue;
    const auto k = static_cast<std::size_t>(std::max(0.0, std::floor(bed.position[i].z)));
    if (slices.size() <= k) slices.resize(k + 1);
    slices[k].mass += 1.0 / bed.motion[i].w;
    slices[k].descent -= bed.motion[i].z / bed.motion[i].w;
  }
  return slices;
}

/// Height of the lowest slice whose grains fall, d; -infinity if none do.
double front_of(double dt, const Grains& bed) {
  const std::vector<Slice> slices = slices_of(bed);
  const auto falls = [&](const Slice& s) { return s.descent > falling_speed * dt * s.mass; };
  const auto front = std::find_if(slices.begin(), slices.end(), falls);
  return front == slices.end() ? -infinity : static_cast<double>(front - slices.begin());
}

}  // namespace

double mass_ratio(const Grains& bed) {
  double least = infinity, most = 0.0;
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    least = std::min(least, bed.motion[i].w);
    most = std::max(most, bed.motion[i].w);
  }
  return bed.grains() == 0 ? 1.0 : most / least;
}

/// By their masses: grains of one scale may be of several shapes, and those of several sizes.
bool may_sleep(const Grains& bed) {
  constexpr double rounding = 1e-9;
  return std::cbrt(1.0 / mass_ratio(bed)) >= least_size_ratio * (1.0 - rounding);
}

bool put_to_sleep(double dt, Grains& bed) {
  const double line = front_of(dt, bed) - sleep_depth;
  bool some = false;
  for (std::size_t i = bed.first_awake; i < bed.grains(); ++i) {
    if (bed.is_asleep(i) || !(bed.position[i].z < line)) continue;
    bed.asleep.resize(bed.grains(), 0);
    bed.asleep[i] = 1;
    some = true;
  }
  while (bed.first_awake < bed.grains() && bed.is_asleep(bed.first_awake)) ++bed.first_awake;
  return some;
}

bool wake(Grains& bed) {
  const bool some = !bed.asleep.empty();
  bed.asleep.clear();
  bed.first_awake = 0;
  return some;
}

}  // namespace grainsweep
