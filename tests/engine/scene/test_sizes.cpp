#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "engine/scene/sizes.hpp"
#include "engine/units.hpp"
#include "tests/support/about.hpp"

namespace grainsweep {
namespace {

PackingSpec spec_of(const Fill& fill, const SizesSpec& sizes, std::uint64_t key = 1) {
  PackingSpec spec;
  spec.fill = fill;
  spec.sizes = sizes;
  spec.random_key = key;
  return spec;
}

TEST_CASE("the reference fill is about 19 spheres per floor area") {
  const PackingSpec spec = spec_of(SolidHeight{9.95}, {});
  const ClassCounts counts = class_counts(spec);
  CHECK(counts.small == 0);
  CHECK(counts.large == 3788);  // 9.95 * 200 / (pi / 6 * (1 + 3 / 900)), rounded
}

TEST_CASE("the small class has its share of the expected volume within half a grain") {
  for (const double share : {0.0, 0.1, 0.25, 0.4, 0.5, 0.9, 1.0}) {
    INFO("share " << share);
    const SizesSpec sizes{0.05, share, 0.4};
    const ClassCounts counts = class_counts(spec_of(SolidHeight{5}, sizes));
    const double growth = 1.0 + 3.0 * 0.05 * 0.05;  // E[D^3] of a Gaussian diameter
    const double large = static_cast<double>(counts.large) * pi / 6 * growth;
    const double small = static_cast<double>(counts.small) * pi / 6 * growth * 0.4 * 0.4 * 0.4;
    const double volume = 5.0 * 20.0 * 10.0;
    CHECK(large == about((1 - share) * volume, 0.51 * pi / 6 * growth));
    CHECK(small == about(share * volume, 0.51 * pi / 6 * growth * 0.064));
  }
}

TEST_CASE("a number of grains is kept exactly, whatever the share of the small class") {
  for (const std::int64_t count : {1, 2, 3, 1000}) {
    for (const double share : {0.0, 0.1, 0.5, 1.0}) {
      const ClassCounts counts = class_counts(spec_of(GrainCount{count}, {0.03, share, 0.5}));
      CHECK(counts.large + counts.small == count);
      CHECK(counts.large >= 0);
      CHECK(counts.small >= 0);
    }
  }
  // Half the volume in grains of an eighth of the volume: eight of nine grains.
  CHECK(class_counts(spec_of(GrainCount{900}, {0.0, 0.5, 0.5})).small == 800);
}

// 20,000 draws: the mean scatters by sd / sqrt(n), the deviation by sd / sqrt(2 n); four of each.
TEST_CASE("radii have the mean and the spread asked for, and none lies beyond four deviations") {
  const double spread = 1.0 / 30.0;
  const auto radii = draw_radii(spec_of(GrainCount{20'000}, {spread, 0, 0.5}));
  double sum = 0, squares = 0;
  for (const double radius : radii) {
    sum += 2 * radius;
    squares += (2 * radius - 1) * (2 * radius - 1);
  }
  const double n = 20'000;
  CHECK(sum / n == about(1, 4 * spread / std::sqrt(n)));
  CHECK(std::sqrt(squares / n) == about(spread, 4 * spread / std::sqrt(2 * n)));
  const auto [least, most] = std::minmax_element(radii.begin(), radii.end());
  CHECK(*least >= 0.5 * (1 - 4 * spread));
  CHECK(*most <= 0.5 * (1 + 4 * spread));
  CHECK(*most > 0.5 * (1 + 3 * spread));  // a cut at three deviations would be seen: 54 expected
}

TEST_CASE("the large class comes first and both are drawn about their own mean") {
  const PackingSpec spec = spec_of(GrainCount{5000}, {0.02, 0.3, 0.25});
  const ClassCounts counts = class_counts(spec);
  const auto radii = draw_radii(spec);
  REQUIRE(radii.size() == 5000);
  REQUIRE(counts.large > 100);
  for (std::size_t i = 0; i < radii.size(); ++i) {
    const double mean = i < static_cast<std::size_t>(counts.large) ? 0.5 : 0.125;
    REQUIRE(std::abs(radii[i] - mean) <= 4 * 0.02 * mean);
  }
}

TEST_CASE("the drawn grains have the share of small volume asked for within half a grain") {
  for (const double ratio : {0.5, 0.2, 0.1}) {
    for (const double share : {0.01, 0.1, 0.25, 0.4, 0.9}) {
      INFO("ratio " << ratio << ", share " << share);
      PackingSpec spec = spec_of(SolidHeight{5}, {1.0 / 30.0, share, ratio});
      spec.box = {6, 4, Boundary::periodic, Boundary::walls};
      const auto radii = draw_radii(spec);
      double small = 0, all = 0;
      for (const double radius : radii) {
        all += sphere_volume(radius);
        if (radius < small_class_limit(spec.sizes)) small += sphere_volume(radius);
      }
      const double largest_small = sphere_volume(0.5 * ratio * (1 + 4.0 / 30.0));
      const double missing = share / (1 - share) * (all - small) - small;
      CHECK(std::abs(missing) <= 0.5 * largest_small * (1 + 1e-9));
    }
  }
}

TEST_CASE("a small share of small grains is kept within a tenth, whatever sizes are drawn") {
  for (std::uint64_t key = 1; key <= 40; ++key) {
    for (const double share : {0.01, 0.05, 0.3}) {
      INFO("key " << key << ", share " << share);
      PackingSpec spec = spec_of(SolidHeight{5}, {0.1, share, 0.3});
      spec.box = {5, 4, Boundary::periodic, Boundary::walls};
      spec.random_key = key;
      double small = 0, large = 0;
      for (const double radius : draw_radii(spec)) {
        (radius < small_class_limit(spec.sizes) ? small : large) += sphere_volume(radius);
      }
      const double wanted = share / (1 - share) * large;
      const double half_grain = sphere_volume(0.15 * 1.4) / 2;  // the last one, of 4 deviations
      CHECK(std::abs(small - wanted) <= 0.1 * wanted + half_grain);
    }
  }
}

TEST_CASE("where large grains are few the height is kept, and shares are as near as that allows") {
  for (const double share : {0.97, 0.98, 0.99, 0.993, 0.9935}) {
    INFO("share " << share);
    PackingSpec spec = spec_of(SolidHeight{5}, {0.02, share, 0.7});
    spec.box = {3, 3, Boundary::periodic, Boundary::walls};
    double volume = 0;
    for (const double radius : draw_radii(spec)) volume += sphere_volume(radius);
    const double half_grain =
        sphere_volume(0.35 * 1.08) / 2;  // the last small one, of 4 deviations
    CHECK(std::abs(volume - 45) <= 0.02 * 45 + half_grain);
  }
}

TEST_CASE("a bed of small grains only has the number expected") {
  const PackingSpec spec = spec_of(SolidHeight{1}, {1.0 / 30.0, 1.0, 0.5});
  CHECK(class_counts(spec).large == 0);
  CHECK(static_cast<std::int64_t>(draw_radii(spec).size()) == class_counts(spec).small);
}

TEST_CASE("without spread all radii of a class are equal") {
  for (const double radius : draw_radii(spec_of(GrainCount{50}, {0, 0, 0.5}))) {
    CHECK(radius == 0.5);
  }
}

TEST_CASE("radii depend on the key and the grain alone") {
  const auto radii = draw_radii(spec_of(GrainCount{100}, {}, 5));
  const auto more = draw_radii(spec_of(GrainCount{300}, {}, 5));
  const auto other = draw_radii(spec_of(GrainCount{100}, {}, 6));
  CHECK(std::equal(radii.begin(), radii.end(), more.begin()));
  int equal = 0;
  for (std::size_t i = 0; i < radii.size(); ++i) {
    equal += radii[i] == other[i] ? 1 : 0;
  }
  CHECK(equal == 0);
}

TEST_CASE("the limit between two classes is equally many deviations from both means") {
  SizesSpec sizes{0.04, 0.3, 0.5};
  const double limit = 2 * small_class_limit(sizes);  // as a diameter
  CHECK((1 - limit) / 0.04 == Approx((limit - 0.5) / (0.04 * 0.5)));
  sizes.small_share = 0;
  CHECK(small_class_limit(sizes) == 0);
  sizes.small_share = 1;
  CHECK(std::isinf(small_class_limit(sizes)));
}

TEST_CASE("the solid height of counted and of placed grains is their volume over the floor") {
  PackingSpec spec = spec_of(GrainCount{100}, {});
  spec.box = {10, 5};
  spec.sizes.distribution = {SizeTable{{1.0, 2.0}, {}, {0.5, 0.5}}, SizeWeight::number};
  CHECK(solid_height(spec) == Approx(100 * (1 + 8) / 2.0 * pi / 6 / 50));
  spec.sizes.distribution.reset();
  spec.shape = Mixture{{{0.5, CubeSize{}}, {0.5, CuboidSize{1, 0.5, 0.5}}}};
  PlacedGrains placed{{{1, 1, 1, 0.5}, {3, 3, 1, 0.5}, {5, 3, 1, 1.0}}, {}};
  placed.components = {0, 1, 1};
  spec.fill = placed;
  CHECK(solid_height(spec) == Approx((1 + 0.25 + 8 * 0.25) / 50));
}

}  // namespace
}  // namespace grainsweep
