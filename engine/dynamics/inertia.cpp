#include "engine/dynamics/inertia.hpp"

#include <algorithm>
#include <cmath>

namespace grainsweep {

double shortened_step(double height) {
  return std::sqrt(even_depth / std::max(even_depth, height));
}

void set_inertia_by_depth(double height, SphereBed& bed) {
  bed.lightness.clear();
  if (height <= even_depth) return;
  for (const Record<double>& p : bed.centres()) {
    bed.lightness.push_back(height / std::max(even_depth, height - p.z));
  }
}

}  // namespace grainsweep
