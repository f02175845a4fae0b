#include "engine/dynamics/inertia.hpp"

#include <algorithm>
#include <cmath>

#include "engine/rows/polyhedron_contacts.hpp"

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
  release_turning(serial_for, bed);
}

}  // namespace grainsweep
