#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "engine/measure/coordination.hpp"
#include "engine/measure/profile.hpp"
#include "engine/measure/solid_fraction.hpp"
#include "engine/shape/mixture.hpp"
#include "engine/units.hpp"
#include "tests/support/about.hpp"
#include "tests/support/draw.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/shape_beds.hpp"
#include "tests/support/tries.hpp"

namespace grainsweep {
namespace {

using testing::Draw;
using testing::periodic;
using testing::random_rotation;
using testing::walls;

Touching touching_in(SphereBed& bed) { return find_touching(bed, 1e-3, kernels_for(best_isa())); }

double mean_of(const Profile& profile) {
  double sum = 0;
  for (const ProfileBin& bin : profile.bins) sum += bin.large + bin.small;
  return sum / static_cast<double>(profile.bins.size());
}

/// Volume that a sphere has between two planes, from the caps below them.
double between(double radius, double low, double high) {
  const auto below = [&](double t) {
    const double h = std::clamp(t + radius, 0.0, 2 * radius);
    return pi * h * h * (3 * radius - h) / 3;
  };
  return below(high) - below(low);
}

TEST_CASE("one sphere anywhere fills the bins along y with its slices, at any bin width") {
  Draw draw(11);
  for (int k = 0; k < 200; ++k) {
    const double r = draw.uniform(0.05, 1.0), y = draw.uniform(0.0, 4.0), z = draw.uniform(3, 5);
    const SphereBed bed = make_bed({5, 4, periodic, walls}, {{2, y, z, r}});
    const double wanted = draw.uniform(0.01, 4.0);
    const Profile profile = profile_along(ProfileAxis::y, bed, {}, {0, 8}, {wanted, 0, 1e-4});
    const auto bins = profile.bins.size();
    REQUIRE(profile.bin_width * static_cast<double>(bins) == Approx(4.0).epsilon(1e-15));
    for (std::size_t n = 0; n < bins; ++n) {
      const double low = n == 0 ? -9 : static_cast<double>(n) * profile.bin_width - y;
      const double high = n + 1 == bins ? 9 : static_cast<double>(n + 1) * profile.bin_width - y;
      const double slice = between(r, low, high) / (5 * 8 * profile.bin_width);
      REQUIRE(profile.bins[n].large == about(slice, 1e-12 * slice + 1e-15));
      REQUIRE(profile.bins[n].small == 0);
    }
  }
}

TEST_CASE("small grains are those below the limit of the classes, one at the limit is large") {
  const SphereBed bed = make_bed({4, 4, periodic, walls}, {{1, 1, 2, 0.5}, {3, 1, 2, 0.49}});
  const Profile profile = profile_along(ProfileAxis::y, bed, {}, {0, 4}, {4.0, 0.5, 1e-4});
  REQUIRE(profile.bins.size() == 1);
  CHECK(profile.bins[0].large_grains == 1);
  CHECK(profile.bins[0].small_grains == 1);
  CHECK(profile.bins[0].large == Approx(sphere_volume(0.5) / 64));
}

TEST_CASE("a profile along x is that along y of the bed turned by a right angle") {
  const std::vector<PlacedSphere> along_x = {{0.4, 2, 4, 0.5}, {3.1, 1, 6, 0.2}};
  const std::vector<PlacedSphere> along_y = {{2, 0.4, 4, 0.5}, {1, 3.1, 6, 0.2}};
  const Profile x = profile_along(ProfileAxis::x, make_bed({4, 5, walls, periodic}, along_x), {},
                                  {3, 6.1}, {0.3, 0.3, 1e-4});
  const Profile y = profile_along(ProfileAxis::y, make_bed({5, 4, periodic, walls}, along_y), {},
                                  {3, 6.1}, {0.3, 0.3, 1e-4});
  REQUIRE(x.bins.size() == y.bins.size());
  for (std::size_t n = 0; n < x.bins.size(); ++n) {
    CHECK(x.bins[n].large == y.bins[n].large);
    CHECK(x.bins[n].small == y.bins[n].small);
    CHECK(x.bins[n].small_grains == y.bins[n].small_grains);
  }
}

/// Mean of a profile from the walls of a duct, each bin weighted by the area of its frame.
double area_mean_of(const Profile& profile, double length, double width) {
  double sum = 0.0;
  const auto inside = [&](double s) { return (length - 2 * s) * (width - 2 * s); };
  for (std::size_t k = 0; k < profile.bins.size(); ++k) {
    const double low = static_cast<double>(k) * profile.bin_width, high = low + profile.bin_width;
    const ProfileBin& bin = profile.bins[k];
    sum += (bin.large + bin.small) * (inside(low) - inside(high));
  }
  return sum / (length * width);
}

// 1e-13: 30 grains, each of whose volumes is a difference of eight parts that are known to 1e-16.
TEST_CASE("the mean over the frames of a duct is the solid fraction of the slab") {
  Draw draw(13);
  for (int k = 0; k < 20; ++k) {
    const double length = draw.uniform(3, 6), width = draw.uniform(3, 6);
    std::vector<PlacedSphere> spheres;
    for (int i = 0; i < 30; ++i) {
      spheres.push_back({draw.uniform(0, length), draw.uniform(0, width), draw.uniform(2, 9),
                         draw.uniform(0.1, 0.6)});
    }
    const SphereBed bed = make_bed({length, width, walls, walls}, spheres);
    const Slab slab{3, 8};
    const Profile profile =
        profile_along(ProfileAxis::from_walls, bed, {}, slab, {draw.uniform(0.05, 3), 0.3, 1e-4});
    CHECK(profile.bin_width * static_cast<double>(profile.bins.size()) ==
          Approx(std::min(length, width) / 2));
    CHECK(area_mean_of(profile, length, width) == Approx(solid_fraction(bed, slab)).epsilon(1e-13));
  }
}

TEST_CASE("the frames of a duct hold the slices of spheres at one wall, and corners once") {
  const SphereBed one = make_bed({6, 4, walls, walls}, {{3, 0.5, 4, 0.5}});
  const Profile middle = profile_along(ProfileAxis::from_walls, one, {}, {0, 8}, {0.25, 0, 1e-4});
  REQUIRE(middle.bins.size() == 8);
  for (std::size_t k = 0; k < 8; ++k) {
    const double low = 0.25 * static_cast<double>(k), high = low + 0.25;
    const double frame = (6 - 2 * low) * (4 - 2 * low) - (6 - 2 * high) * (4 - 2 * high);
    CHECK(middle.bins[k].large * frame * 8 == about(between(0.5, low - 0.5, high - 0.5), 1e-14));
    CHECK(middle.bins[k].large_grains == (k == 2 ? 1 : 0));  // its centre is 0.5 d from the wall
  }
  const SphereBed corner = make_bed({6, 4, walls, walls}, {{5.5, 3.5, 4, 0.5}});
  const Profile both = profile_along(ProfileAxis::from_walls, corner, {}, {0, 8}, {0.5, 0, 1e-4});
  const double quarter = sphere_volume(0.5) / 4;  // more than 0.5 d from both walls
  CHECK(both.bins[0].large * (6 * 4 - 5 * 3) * 8 == Approx(3 * quarter).epsilon(1e-14));
  CHECK(both.bins[1].large * (5 * 3 - 4 * 2) * 8 == Approx(quarter).epsilon(1e-14));
  CHECK(both.bins[2].large == Approx(0).margin(1e-15));
}

/// Spheres anywhere in a tube, some reaching through its wall's inner half of them.
SphereBed random_tube(double diameter, Draw& draw) {
  std::vector<PlacedSphere> spheres;
  while (spheres.size() < 60) {
    const PlacedSphere s{draw.uniform(0, diameter), draw.uniform(0, diameter), draw.uniform(1, 9),
                         draw.uniform(0.1, 0.5)};
    if (std::hypot(s.x - diameter / 2, s.y - diameter / 2) + s.radius <= diameter / 2) {
      spheres.push_back(s);
    }
  }
  return make_bed(tube_of(diameter), spheres);
}

/// Of a tube, each ring weighted by its area.
double ring_mean_of(const Profile& profile, double diameter) {
  double sum = 0;
  for (std::size_t k = 0; k < profile.bins.size(); ++k) {
    const double low = profile.bin_width * static_cast<double>(k), high = low + profile.bin_width;
    sum += (profile.bins[k].large + profile.bins[k].small) * (high - low) * (diameter - low - high);
  }
  return sum / (diameter * diameter / 4);
}

TEST_CASE("the mean over the rings of a tube, each by its area, is its solid fraction") {
  Draw draw(31);
  for (const double diameter : {1.3, 2.0, 3.7, 12.0, 400.0}) {
    const SphereBed bed = random_tube(diameter, draw);
    const Slab slab{2.3, 7.1};
    for (const double bin : {0.02, 0.11, 0.6}) {
      INFO("D = " << diameter << ", bins of " << bin);
      const Profile profile = profile_along(ProfileAxis::from_walls, bed, {}, slab,
                                            {std::min(bin * diameter, diameter / 2), 0.3, 1e-4});
      CHECK(profile.bin_width * static_cast<double>(profile.bins.size()) == Approx(diameter / 2));
      // 60 spheres, each exact to 1e-13 of its volume, which is up to the whole of what is there.
      CHECK(ring_mean_of(profile, diameter) == Approx(solid_fraction(bed, slab)).epsilon(1e-12));
    }
  }
}

TEST_CASE("a bed turned about the axis of its tube has the same profile") {
  Draw draw(32);
  const double diameter = 4.6, angle = 1.1;
  const SphereBed bed = random_tube(diameter, draw);
  SphereBed turned = bed;
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    const double x = bed.position[i].x - diameter / 2, y = bed.position[i].y - diameter / 2;
    turned.position[i].x = diameter / 2 + std::cos(angle) * x - std::sin(angle) * y;
    turned.position[i].y = diameter / 2 + std::sin(angle) * x + std::cos(angle) * y;
  }
  const Slab slab{2, 8};
  const ProfileSettings settings{0.2, 0.3, 1e-4};
  const Profile one = profile_along(ProfileAxis::from_walls, bed, {}, slab, settings);
  const Profile other = profile_along(ProfileAxis::from_walls, turned, {}, slab, settings);
  CHECK(solid_fraction(turned, slab) == Approx(solid_fraction(bed, slab)).epsilon(1e-14));
  REQUIRE(one.bins.size() == other.bins.size());
  for (std::size_t k = 0; k < one.bins.size(); ++k) {
    CHECK(other.bins[k].large == about(one.bins[k].large, 1e-12));
    CHECK(other.bins[k].small == about(one.bins[k].small, 1e-12));
  }
}

TEST_CASE("the wall of a wide tube shows a sphere as a flat wall does") {
  // At D = 1e4 d the wall leaves its tangent by 0.5^2 / 1e4 d within a sphere's reach.
  constexpr double diameter = 1e4;
  const SphereBed tube = make_bed(tube_of(diameter), {{0.7, diameter / 2, 4, 0.5}});
  const SphereBed flat =
      make_bed({diameter, diameter, walls, walls}, {{0.7, diameter / 2, 4, 0.5}});
  const ProfileSettings settings{0.1, 0.3, 1e-4};
  const Profile round = profile_along(ProfileAxis::from_walls, tube, {}, {0, 8}, settings);
  const Profile square = profile_along(ProfileAxis::x, flat, {}, {0, 8}, settings);
  for (std::size_t k = 0; k < 13; ++k) {
    const double low = 0.1 * static_cast<double>(k), area = pi * 0.1 * (diameter - 2 * low - 0.1);
    CHECK(round.bins[k].large * area * 8 ==
          about(square.bins[k].large * 0.1 * diameter * 8, 3e-5 * sphere_volume(0.5)));
  }
}

TEST_CASE("a sphere across a periodic border fills the bins of both sides") {
  const SphereBed bed = make_bed({5, 4, periodic, periodic}, {{2, 3.9, 4, 0.5}});
  const Profile profile = profile_along(ProfileAxis::y, bed, {}, {0, 8}, {0.5, 0, 1e-4});
  REQUIRE(profile.bins.size() == 8);
  const double bin = 5 * 8 * 0.5;
  CHECK(profile.bins[6].large * bin == Approx(between(0.5, -0.9, -0.4)).epsilon(1e-12));
  CHECK(profile.bins[7].large * bin == Approx(between(0.5, -0.4, 0.1)).epsilon(1e-12));
  CHECK(profile.bins[0].large * bin == Approx(between(0.5, 0.1, 0.6)).epsilon(1e-12));
  CHECK(profile.bins[1].large == 0);
}

TEST_CASE("one sphere anywhere fills the bins along z with its slices") {
  Draw draw(12);
  for (int k = 0; k < 100; ++k) {
    const double r = draw.uniform(0.05, 1.0), z = r + draw.uniform(0.0, 4.0);
    const SphereBed bed = make_bed({5, 4, periodic, walls}, {{2, 2, z, r}});
    const double width = draw.uniform(0.01, 4.0);
    const Profile profile = profile_along(ProfileAxis::z, bed, {}, {}, {width, 0, 1e-4});
    REQUIRE(static_cast<double>(profile.bins.size()) * width >= (z + r) * (1 - 1e-15));
    for (std::size_t n = 0; n < profile.bins.size(); ++n) {
      const double low = static_cast<double>(n) * width - z;
      const double slice = between(r, low, low + width) / (5 * 4 * width);
      REQUIRE(profile.bins[n].large == about(slice, 1e-12 * slice + 1e-15));
    }
  }
}

// Across a simple cubic block a bin as wide as the lattice holds whole slices; finer bins follow
// the disc of one sphere a unit cell: phi(y) = pi (1/4 - y^2), which a bin averages exactly.
TEST_CASE("the profile of a cubic block is that of one of its cells") {
  const SphereBed bed = testing::simple_cubic_bed(4, 5, 9);
  for (const double width : {1.0, 0.5, 0.25, 0.1, 0.02}) {
    const Profile profile = profile_along(ProfileAxis::y, bed, {}, {1.3, 6.3}, {width, 0, 1e-4});
    for (std::size_t k = 0; k < profile.bins.size(); ++k) {
      const double low = std::remainder(static_cast<double>(k) * width, 1.0);
      const auto filled = [](double t) { return pi * (t / 4 - t * t * t / 3); };
      const double high = low + width;
      const double slice = high <= 0.5 + 1e-12
                               ? filled(high) - filled(low)
                               : filled(0.5) - filled(low) + filled(high - 1) - filled(-0.5);
      REQUIRE(profile.bins[k].large == Approx(slice / width).epsilon(1e-12));
    }
  }
}

TEST_CASE("whole cells of a face-centred block fill pi / sqrt 18 in every direction") {
  const SphereBed bed = testing::fcc_bed(3, 4, 6);
  const double edge = std::sqrt(2.0), filled = pi / std::sqrt(18.0);
  const Profile across =
      profile_along(ProfileAxis::y, bed, {}, {1.1, 1.1 + 3 * edge}, {edge, 0, 1e-4});
  REQUIRE(across.bins.size() == 4);
  for (const ProfileBin& bin : across.bins) CHECK(bin.large == Approx(filled).epsilon(1e-12));
  const Profile up = profile_along(ProfileAxis::z, bed, {}, {}, {edge, 0, 1e-4});
  for (std::size_t k = 1; k < 5; ++k) CHECK(up.bins[k].large == Approx(filled).epsilon(1e-12));
}

// The slab cuts spheres at its top and bottom, walls and periodic borders cut them at the sides.
TEST_CASE("the mean of the profile is the solid fraction of the slab, both classes together") {
  for (const Boundary y : {walls, periodic}) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      const SphereBed bed = testing::random_bed({{6, 4, periodic, y}, 300, 0.1, 0.5, 9, seed});
      const Slab slab{1.7, 6.9};
      const double phi = solid_fraction(bed, slab);
      for (const double width : {0.07, 0.1, 1.3, 4.0}) {
        const Profile profile = profile_along(ProfileAxis::y, bed, {}, slab, {width, 0.3, 1e-4});
        REQUIRE(mean_of(profile) == Approx(phi).epsilon(1e-12));
      }
    }
  }
}

TEST_CASE("along z the bins of a slab have its solid fraction as their mean") {
  const SphereBed bed = testing::random_bed({{6, 4, periodic, walls}, 300, 0.1, 0.5, 9, 4});
  const Profile profile = profile_along(ProfileAxis::z, bed, {}, {}, {0.25, 0.3, 1e-4});
  double sum = 0;
  for (std::size_t k = 8; k < 24; ++k) sum += profile.bins[k].large + profile.bins[k].small;
  CHECK(sum / 16 == Approx(solid_fraction(bed, {2, 6})).epsilon(1e-12));
}

TEST_CASE("each class has the profile it has alone") {
  const Box box{6, 4, periodic, walls};
  std::vector<PlacedSphere> large, small, both;
  Draw draw(3);
  for (int k = 0; k < 60; ++k) {
    const bool is_small = k % 3 == 0;
    const PlacedSphere sphere{draw.uniform(0, 6), draw.uniform(0, 4), draw.uniform(1, 8),
                              is_small ? 0.25 : 0.5};
    (is_small ? small : large).push_back(sphere);
    both.push_back(sphere);
  }
  const Slab slab{2, 7};
  const ProfileSettings settings{0.1, 1.0 / 3.0, 1e-4};
  const Profile mixed = profile_along(ProfileAxis::y, make_bed(box, both), {}, slab, settings);
  const Profile alone_large =
      profile_along(ProfileAxis::y, make_bed(box, large), {}, slab, settings);
  const Profile alone_small =
      profile_along(ProfileAxis::y, make_bed(box, small), {}, slab, settings);
  for (std::size_t k = 0; k < mixed.bins.size(); ++k) {
    CHECK(mixed.bins[k].large == alone_large.bins[k].large);
    CHECK(mixed.bins[k].small == alone_small.bins[k].small);
    CHECK(mixed.bins[k].small_grains == alone_small.bins[k].small_grains);
    CHECK(mixed.bins[k].large_grains == alone_large.bins[k].large_grains);
  }
}

// Six neighbours inside a cubic block, five on the floor and in the top layer.
TEST_CASE("a cubic block's grains have their neighbours in the bin of their centre") {
  SphereBed bed = testing::simple_cubic_bed(4, 5, 6);
  const Touching touching = touching_in(bed);
  const Profile up = profile_along(ProfileAxis::z, bed, touching, {}, {1.0, 0, 1e-4});
  REQUIRE(up.bins.size() == 6);
  for (std::size_t k = 0; k < 6; ++k) {
    const bool at_end = k == 0 || k == 5;
    CHECK(up.bins[k].large_grains == 20);
    CHECK(up.bins[k].neighbours == 20 * (at_end ? 5 : 6));
    CHECK(up.bins[k].walls == (k == 0 ? 20 : 0));
  }
}

TEST_CASE("the bins along y hold the grains and the neighbours of the slab's coordination") {
  SphereBed bed = testing::random_bed({{6, 4, periodic, walls}, 400, 0.2, 0.5, 6, 8});
  const Touching touching = touching_in(bed);
  const Slab slab{1.5, 4.5};
  const Profile profile = profile_along(ProfileAxis::y, bed, touching, slab, {0.1, 0.3, 1e-4});
  std::int64_t grains = 0, neighbours = 0, with_walls = 0;
  for (const ProfileBin& bin : profile.bins) {
    grains += bin.large_grains + bin.small_grains;
    neighbours += bin.neighbours;
    with_walls += bin.neighbours + bin.walls;
  }
  const Coordination whole = coordination(bed, touching, slab, 1e-4);
  const double per_grain = 1.0 / static_cast<double>(grains);
  CHECK(static_cast<double>(neighbours) * per_grain == Approx(whole.between_grains));
  CHECK(static_cast<double>(with_walls) * per_grain == Approx(whole.with_walls));
}

TEST_CASE("touching is judged at the tolerance of the settings") {
  SphereBed bed = make_bed({5, 4, periodic, walls}, {{1, 1, 2, 0.5}, {2.0005, 1, 2, 0.5}});
  const Touching touching = touching_in(bed);
  CHECK(profile_along(ProfileAxis::z, bed, touching, {}, {1, 0, 1e-3}).bins[2].neighbours == 2);
  CHECK(profile_along(ProfileAxis::z, bed, touching, {}, {1, 0, 1e-4}).bins[2].neighbours == 0);
}

/// Cubes, flat bricks and spheres at random, in a bed of which some touch.
PolyhedronBed mixture_bed(const Box& box, std::uint64_t seed) {
  Draw draw(seed);
  std::vector<std::uint8_t> components;
  std::vector<Pose> poses;
  for (std::size_t i = 0; i < 150; ++i) {
    components.push_back(static_cast<std::uint8_t>(draw.uniform(0, 3)));
    const double x = draw.uniform(0.6, box.length - 0.6), y = draw.uniform(0.6, box.width - 0.6);
    poses.push_back({{x, y, draw.uniform(0.5, 5)}, draw.uniform(0.5, 1), random_rotation(draw)});
  }
  return make_bed(
      box,
      shapes_of(Mixture{{{0.4, CubeSize{}}, {0.3, CuboidSize{1, 1, 0.4}}, {0.3, SphereShape{}}}}),
      components, poses);
}

/// The profiles of a bed, whole and of its components, along each axis that it has.
struct BothProfiles {
  Profile whole;
  std::vector<ComponentProfile> parts;
};
std::vector<BothProfiles> profiles_of(const PolyhedronBed& bed, const Touching& touching,
                                      const Slab& slab, const ProfileSettings& s) {
  std::vector<BothProfiles> all = {{profile_along(ProfileAxis::z, bed, touching, {}, s),
                                    component_profiles(ProfileAxis::z, bed, touching, {}, s)}};
  if (!bed.box.is_tube) {
    for (const ProfileAxis axis : {ProfileAxis::x, ProfileAxis::y}) {
      all.push_back({profile_along(axis, bed, touching, slab, s),
                     component_profiles(axis, bed, touching, slab, s)});
    }
  }
  if (bed.box.x == walls) {
    all.push_back({profile_along(ProfileAxis::from_walls, bed, touching, slab, s),
                   component_profiles(ProfileAxis::from_walls, bed, touching, slab, s)});
  }
  return all;
}

// Bins are differences of volumes, each of which is known to rounding.
TEST_CASE("no bin of a profile holds less than nothing") {
  Draw draw(37);
  for (int k = 0; k < testing::tries(20); ++k) {
    const double length = draw.uniform(2, 6), width = draw.uniform(2, 6);
    const Slab slab{draw.uniform(0, 2), draw.uniform(3, 7)};
    const ProfileSettings settings{draw.uniform(0.01, 0.3), 0.7, 1e-4};
    for (const Box& box : {Box{length, width, walls, walls}, tube_of(length)}) {
      for (const BothProfiles& profiles :
           profiles_of(mixture_bed(box, 100 + static_cast<std::uint64_t>(k)), {}, slab, settings)) {
        for (const ProfileBin& bin : profiles.whole.bins) {
          REQUIRE(std::min(bin.large, bin.small) >= 0);
        }
        for (const ComponentProfile& part : profiles.parts) {
          for (const ComponentBin& bin : part.bins) REQUIRE(bin.solid_fraction >= 0);
        }
      }
    }
  }
}

TEST_CASE("the profiles of the components of a mixture add up to that of the bed") {
  Box tube{4, 4, walls, walls};
  tube.is_tube = true;
  for (const Box& box : {Box{5, 4, periodic, walls}, Box{5, 4, walls, walls}, tube}) {
    PolyhedronBed bed = mixture_bed(box, 7);
    const Touching touching = find_touching(bed, 0.05, kernels_for(best_isa()));
    REQUIRE(touching.pairs.size() > 50);
    for (const auto& [whole, parts] : profiles_of(bed, touching, {1, 4}, {0.3, 0.4, 0.05})) {
      REQUIRE(parts.size() == 3);
      for (const ComponentProfile& part : parts) {
        REQUIRE(part.bin_width == whole.bin_width);
        REQUIRE(part.bins.size() == whole.bins.size());
      }
      for (std::size_t k = 0; k < whole.bins.size(); ++k) {
        double filled = 0;
        std::int64_t grains = 0, neighbours = 0, touched_walls = 0;
        for (const ComponentProfile& part : parts) {
          const ComponentBin& bin = part.bins[k];
          filled += bin.solid_fraction;
          grains += bin.grains;
          touched_walls += bin.walls;
          for (const std::int64_t number : bin.neighbours) neighbours += number;
        }
        const ProfileBin& bin = whole.bins[k];
        // Hundreds of volumes are added up in two orders, each rounded; a full bin is 1.
        CHECK(filled == about(bin.large + bin.small, 1e-13));
        CHECK(grains == bin.large_grains + bin.small_grains);
        CHECK(neighbours == bin.neighbours);
        CHECK(touched_walls == bin.walls);
      }
    }
  }
}

TEST_CASE("neighbours in the profiles of components are those of a count over all pairs") {
  PolyhedronBed bed = mixture_bed({5, 4, periodic, walls}, 8);
  const Touching touching = find_touching(bed, 0.05, kernels_for(best_isa()));
  const Slab slab{1, 4};
  const auto parts = component_profiles(ProfileAxis::y, bed, touching, slab, {0.5, 0, 0.02});
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t number = 0; number < 8; ++number) {
      const auto is_in = [&](std::int32_t index) {
        const auto i = static_cast<std::size_t>(index);
        const Record<double>& p = bed.position[i];
        const double low = 0.5 * static_cast<double>(number);
        return bed.component(i) == k && slab.contains(p.z) && p.y >= low && p.y < low + 0.5;
      };
      const ComponentBin& bin = parts[k].bins[number];
      std::int64_t grains = 0;
      for (std::int32_t i = 0; i < bed.wall(); ++i) grains += is_in(i) ? 1 : 0;
      CHECK(bin.grains == grains);
      for (std::size_t other = 0; other < 3; ++other) {
        const auto counts = [&](std::int32_t grain, std::int32_t touched) {
          return is_in(grain) && bed.component(static_cast<std::size_t>(touched)) == other ? 1 : 0;
        };
        std::int64_t expected = 0;
        for (const TouchingPair& pair : touching.pairs) {
          if (pair.gap < 0.02) expected += counts(pair.a, pair.b) + counts(pair.b, pair.a);
        }
        CHECK(bin.neighbours[other] == expected);
      }
    }
  }
}

TEST_CASE("a component's profile is that of its grains alone, and says how they point") {
  const Quaternion lying(Eigen::AngleAxisd(pi / 2, Vector::UnitX()));
  const std::vector<ConvexShape> shapes =
      shapes_of(Mixture{{{0.5, CuboidSize{1, 1, 0.5}}, {0.5, SphereShape{}}}});
  // Two bricks below y = 2, one of which lies on its side, and an upright one above; a sphere.
  const std::vector<Pose> bricks = {{{1, 1, 2}, 1, Quaternion::Identity()},
                                    {{3, 1, 2}, 1, lying},
                                    {{1, 3, 2}, 1, Quaternion::Identity()}};
  std::vector<Pose> both = bricks;
  both.push_back({{3, 3, 2}, 1, Quaternion::Identity()});
  const Box box{4, 4, periodic, walls};
  const Slab slab{0.5, 4};
  const PolyhedronBed bed = make_bed(box, shapes, {0, 0, 0, 1}, both);
  const auto parts = component_profiles(ProfileAxis::y, bed, {}, slab, {2, 0, 1e-4});
  const Profile alone = profile_along(
      ProfileAxis::y, testing::shape_bed(box, shapes.front(), bricks), {}, slab, {2, 0, 1e-4});
  REQUIRE(parts.size() == 2);
  for (std::size_t k : {0, 1}) {
    CHECK(parts[0].bins[k].solid_fraction == alone.bins[k].large);
    CHECK(parts[0].bins[k].grains == alone.bins[k].large_grains);
  }
  // Axes z and y at right angles are both in one plane, 1/4; x is shared, and so is any of one.
  CHECK(parts[0].bins[0].nematic[0] == Approx(1));
  CHECK(parts[0].bins[0].nematic[1] == Approx(0.25));
  CHECK(parts[0].bins[0].nematic[2] == Approx(0.25));
  CHECK(parts[0].bins[1].nematic[2] == Approx(1));
  CHECK(std::isnan(parts[1].bins[1].nematic[2]));  // spheres point nowhere
  CHECK(parts[1].bins[1].solid_fraction == Approx(sphere_volume(0.5) / (4 * 2 * 3.5)));
  CHECK(parts[1].bins[0].grains == 0);
}

TEST_CASE("an empty bed has empty bins") {
  const SphereBed bed = make_bed({6, 4, periodic, walls}, {});
  CHECK(mean_of(profile_along(ProfileAxis::y, bed, {}, {0, 1}, {0.1, 0, 1e-4})) == 0);
  CHECK(mean_of(profile_along(ProfileAxis::z, bed, {}, {}, {0.1, 0, 1e-4})) == 0);
}

}  // namespace
}  // namespace grainsweep
