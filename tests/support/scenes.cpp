#include "tests/support/scenes.hpp"

#include <cmath>

#include "tests/support/draw.hpp"

namespace grainsweep::testing {

namespace {

/// The points of `cell`, in units of `edge`, repeated nx by ny by nz times; the lowest touch the
/// floor.
SphereBed lattice_bed(const std::vector<PlacedSphere>& cell, double edge, int nx, int ny, int nz) {
  std::vector<PlacedSphere> spheres;
  for (int k = 0; k < nz; ++k) {
    for (int j = 0; j < ny; ++j) {
      for (int i = 0; i < nx; ++i) {
        for (const PlacedSphere& p : cell) {
          spheres.push_back({(i + p.x) * edge, (j + p.y) * edge, (k + p.z) * edge + 0.5, 0.5});
        }
      }
    }
  }
  return make_bed({nx * edge, ny * edge, periodic, periodic}, spheres);
}

}  // namespace

SphereBed random_bed(const RandomScene& scene) {
  Draw draw(scene.seed);
  std::vector<PlacedSphere> spheres;
  for (std::size_t i = 0; i < scene.grains; ++i) {
    const double x = draw.uniform(0.0, scene.box.length), y = draw.uniform(0.0, scene.box.width);
    const double z = draw.uniform(0.0, scene.height);
    spheres.push_back({x, y, z, draw.uniform(scene.min_radius, scene.largest_radius)});
  }
  return make_bed(scene.box, spheres);
}

SphereBed simple_cubic_bed(int nx, int ny, int nz) {
  return lattice_bed({{0, 0, 0}}, 1.0, nx, ny, nz);
}

SphereBed fcc_bed(int nx, int ny, int nz) {
  return lattice_bed({{0, 0, 0}, {0.5, 0.5, 0}, {0.5, 0, 0.5}, {0, 0.5, 0.5}}, std::sqrt(2.0), nx,
                     ny, nz);
}

SphereBed column_bed(int grains, double gap) {
  std::vector<PlacedSphere> spheres;
  for (int k = 0; k < grains; ++k) {
    spheres.push_back({2.0, 2.0, k + 0.5 + (k + 1) * gap, 0.5});
  }
  return make_bed({4.0, 4.0, periodic, walls}, spheres);
}

}  // namespace grainsweep::testing
