#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <catch2/catch.hpp>

#include "engine/units.hpp"
#include "runner/export/voxels.hpp"
#include "tests/runner/export/touching_beds.hpp"

namespace grainsweep {
namespace {

std::string bytes_of(const std::string& nrrd) { return nrrd.substr(nrrd.find("\n\n") + 2); }

/// Volume of the voxels of a class, d^3.
double volume_of(const ExportedBed& exported, char size_class) {
  const VoxelGrid grid = voxel_grid(exported.bed, exported.settings.voxels);
  const std::string bytes = bytes_of(voxels_nrrd(exported));
  REQUIRE(bytes.size() == grid.count[0] * grid.count[1] * grid.count[2]);
  const auto count = static_cast<double>(std::count(bytes.begin(), bytes.end(), size_class));
  return count * grid.size[0] * grid.size[1] * grid.size[2];
}

TEST_CASE("voxels fill the box, and the header says how they lie") {
  ExportedBed exported = empty_box(4, 2.5, 1.01);
  exported.settings.voxels = 3;
  CHECK(voxels_nrrd(exported).substr(0, voxels_nrrd(exported).find("\n\n")) ==
        "NRRD0004\n# lengths in d; 0 void, 1 large grains, 2 small ones\ntype: uint8\n"
        "dimension: 3\nsizes: 12 8 4\nspacings: 0.3333333333333333 0.3125 0.3333333333333333\n"
        "axis mins: 0 0 0\ncenters: cell cell cell\nencoding: raw");
  CHECK(bytes_of(voxels_nrrd(exported)) == std::string(12 * 8 * 4, '\0'));
  exported.settings.lengths = {3.0, "mm", {}};
  CHECK_THAT(voxels_nrrd(exported), Catch::Contains("# lengths in mm;") &&
                                        Catch::Contains("sizes: 12 8 4\nspacings: 1 0.9375 1\n"));
}

TEST_CASE(
    "at 60 voxels a d spheres have their volume to a thousandth, across periodic sides, too") {
  ExportedBed exported = stacked_spheres();
  exported.small_limit = 0.3;
  exported.bed.grains[1] = {0.703, 0.907, 0.505, 0.25, 0, 0};
  exported.settings.voxels = 60;
  CHECK(volume_of(exported, 1) == Approx(sphere_volume(0.5)).epsilon(1e-3));
  // Fifteen voxels of radius: grid lines through its middle would make it worse.
  CHECK(volume_of(exported, 2) == Approx(sphere_volume(0.25)).epsilon(4e-3));
}

TEST_CASE(
    "voxels of a cube are exactly those within its faces, however it is turned by a right angle") {
  ExportedBed exported = stacked_cubes();
  exported.settings.voxels = 20;
  const double half = std::sqrt(0.5);
  for (const auto& turn : {std::array{0.0, 0.0, 0.0, 1.0}, std::array{half, 0.0, 0.0, half}}) {
    exported.bed.turned->orientations = {turn, turn};
    CHECK(volume_of(exported, 1) == Approx(2).epsilon(1e-12));
  }
}

TEST_CASE("what lies outside a tube is neither void nor grain") {
  ExportedBed exported = empty_box(4, 4, 1);
  exported.bed.box = tube_of(4);
  exported.settings.voxels = 50;
  const double inside = volume_of(exported, '\0'), outside = volume_of(exported, '\xff');
  const double height = (inside + outside) / 16;
  // Voxels that the wall cuts, one in the round or out of it: a hundredth of a voxel on average.
  CHECK(inside == Approx(pi * 4 * height).epsilon(1e-3));
  CHECK(voxels_nrrd(exported).find("255 outside the tube") != std::string::npos);
}

TEST_CASE("no more voxels are asked for than there is memory for") {
  ExportedBed exported = empty_box(1000, 1000, 1000);
  exported.settings.voxels = 1000;
  CHECK_THROWS_WITH(voxels_nrrd(exported),
                    Catch::Contains("--voxels 1000") && Catch::Contains("take fewer a d"));
}

TEST_CASE("x runs fastest, then y") {
  ExportedBed exported = empty_box(3, 2, 1);
  exported.bed.grains = {{2.5, 0.5, 0.5, 0.1, 0, 0}, {0.5, 1.5, 0.5, 0.5, 0, 0}};
  exported.small_limit = 0.3;
  exported.settings.voxels = 1;
  CHECK(bytes_of(voxels_nrrd(exported)) == std::string("\0\0\2\1\0\0", 6));
}

}  // namespace
}  // namespace grainsweep
