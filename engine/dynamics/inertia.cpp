#include "engine/dynamics/inertia.hpp"

#include <algorithm>
#include <cmath>

namespace grainsweep {

double shortened_step(double height) {
  return std::sqrt(even_depth / std::max(even_depth, height));
}

namespace {

void set_lightness(double height, Grains& bed) {
  bed.lightness.clear();
  if (height <= even_depth) return;
  for (const Record<double>& p : bed.centres()) {
    bed.lightness.push_back(height / std::max(even_depth, height - p.z));
  }
}

}  // namespace

void set_inertia_by_depth(double height, SphereBed& bed) { set_lightness(height, bed); }
void set_inertia_by_depth(double height, PolyhedronBed& bed) {
  set_lightness(height, bed);
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    bed.root_inertia[i] = principal_moments(bed, i).cwiseSqrt();
  }
}

}  // namespace grainsweep
