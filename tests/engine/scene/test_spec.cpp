// The rules of engine/scene/spec.hpp, which tell a sweep's author what to change.
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <variant>

#include <catch2/catch.hpp>

#include "engine/dynamics/presets.hpp"
#include "engine/scene/spec.hpp"
#include "engine/units.hpp"

namespace grainsweep {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// A specification in which every rule holds, with one change.
template <class Change>
PackingSpec changed(Change change) {
  PackingSpec spec;
  change(spec);
  return spec;
}

/// "path: message" of every broken rule.
template <class Change>
std::vector<std::string> broken_by(Change change) {
  std::vector<std::string> broken;
  for (const SpecError& error : check(changed(change))) {
    broken.push_back(error.path + ": " + error.message);
  }
  return broken;
}

using Messages = std::vector<std::string>;

}  // namespace

TEST_CASE("the default specification and every preset break no rule") {
  CHECK(check(PackingSpec{}).empty());
  for (const Preset& known : presets()) {
    INFO(known.name);
    CHECK(broken_by([&](PackingSpec& spec) { spec.accuracy = known.accuracy; }).empty());
  }
}

TEST_CASE("a wall gap must hold the largest grain") {
  const auto width = [](double w, double spread) {
    return broken_by([=](PackingSpec& spec) {
      spec.box.width = w;
      spec.sizes.spread = spread;
    });
  };
  CHECK(width(1.0, 0.0).empty());
  CHECK(width(0.999, 0.0) == Messages{"box.width: must lie in [1, 10000], is 0.999"});
  CHECK(width(1.2, 0.05).empty());
  CHECK(width(1.1, 0.05) ==
        Messages{"box.width: must lie in [1.2, 10000] (the largest grain between two walls), is "
                 "1.1"});
  CHECK(width(nan, 0.0) == Messages{"box.width: must lie in [1, 10000], is nan"});
  CHECK(width(infinity, 0.0) == Messages{"box.width: must lie in [1, 10000], is inf"});
}

TEST_CASE(
    "small grains alone need a smaller gap, but never less than one diameter of a large one") {
  const auto width = [](double w) {
    return broken_by([=](PackingSpec& spec) {
      spec.box.width = w;
      spec.sizes = {0.2, 1.0, 0.5};
    });
  };
  CHECK(width(1.0).empty());  // the largest grain is 0.9 wide
  CHECK(width(0.95).size() == 1);
}

TEST_CASE("periodic sides must keep a grain away from its own image") {
  const auto sides = [](double side) {
    return broken_by([=](PackingSpec& spec) {
      spec.sizes.spread = 0.0;
      spec.box = {side, side, Boundary::periodic, Boundary::periodic};
    });
  };
  CHECK(sides(2.4).empty());
  CHECK(sides(2.39) ==
        Messages{"box.length: must lie in [2.4, 10000] (periodic: twice the largest grain and a "
                 "margin), is 2.39",
                 "box.width: must lie in [2.4, 10000] (periodic: twice the largest grain and a "
                 "margin), is 2.39"});
}

TEST_CASE("walls along x, too, are as far apart as the largest grain") {
  const auto length = [](double l) {
    return broken_by([=](PackingSpec& spec) {
      spec.box = {l, 5, Boundary::walls, Boundary::walls};
    });
  };
  CHECK(length(1.2).empty());
  CHECK(length(1.1) ==
        Messages{"box.length: must lie in [1.13334, 10000] (the largest grain between two walls), "
                 "is 1.1"});
  CHECK(length(10'001.0).size() == 1);
}

TEST_CASE("solid height is positive and at most 1000, and gives a possible number of grains") {
  const auto height = [](double h, double side = 10.0) {
    return broken_by([=](PackingSpec& spec) {
      spec.fill = SolidHeight{h};
      spec.box.length = spec.box.width = side;
    });
  };
  CHECK(height(1000.0).empty());
  CHECK(height(0.0) == Messages{"fill.solid_height: must lie in (0, 1000], is 0"});
  CHECK(height(1000.1) == Messages{"fill.solid_height: must lie in (0, 1000], is 1000.1"});
  CHECK(height(nan) == Messages{"fill.solid_height: must lie in (0, 1000], is nan"});
  CHECK(height(0.001) == Messages{"fill.solid_height: must give 1 to 10000000 grains, gives 0"});
  REQUIRE(height(1000.0, 10'000.0).size() == 1);
  CHECK(height(1000.0, 10'000.0)[0].starts_with(
      "fill.solid_height: must give 1 to 10000000 grains, gives 190"));
}

TEST_CASE("grains are counted from one to ten million") {
  const auto grains = [](std::int64_t n) {
    return broken_by([=](PackingSpec& spec) {
      spec.box = {1000, 1000};
      spec.fill = GrainCount{n};
      spec.measure.exclude_floor = spec.measure.exclude_surface = 0.0;
    });
  };
  CHECK(grains(1).empty());
  CHECK(grains(10'000'000).empty());
  CHECK(grains(0) == Messages{"fill.grains: must give 1 to 10000000 grains, gives 0"});
  CHECK(grains(-5) == Messages{"fill.grains: must give 1 to 10000000 grains, gives -5"});
  CHECK(grains(10'000'001).size() == 1);
}

TEST_CASE("placed grains must lie in the box, have a radius and be finite") {
  const auto placed = [](std::vector<PlacedSphere> grains, Boundary x = Boundary::periodic) {
    return broken_by([=](PackingSpec& spec) {
      spec.box = {10.0, 6.0, x, Boundary::walls};
      spec.fill = PlacedGrains{grains};
    });
  };
  CHECK(placed({{5, 3, 1, 0.5}}).empty());
  CHECK(placed({}) == Messages{"fill.file: must give 1 to 10000000 grains, gives 0"});
  CHECK(placed({{0, 0.5, 0.5, 0.5}}).empty());  // touches wall and floor, astride the periodic side
  CHECK(placed({{0, 0.495, 0.495, 0.5}}).empty());  // overlaps them as a settled bed may
  CHECK(placed({{5, 3, 1, 0.5}, {5, 5.7, 1, 0.5}}) ==
        Messages{"fill.file: grain 2 lies outside the box: y = 5.7, radius 0.5, box.width 6"});
  CHECK(placed({{0.2, 3, 1, 0.5}}, Boundary::walls) ==
        Messages{"fill.file: grain 1 lies outside the box: x = 0.2, radius 0.5, box.length 10"});
  CHECK(placed({{10.1, 3, 1, 0.5}}) ==
        Messages{"fill.file: grain 1 lies outside the box: x = 10.1, radius 0.5, box.length 10"});
  CHECK(placed({{5, 3, 0.2, 0.5}, {5, 3, -1, 0.5}}) ==
        Messages{"fill.file: grain 1 lies below the floor or too high: z = 0.2, radius 0.5; 2 "
                 "grains are wrong in all"});
  CHECK(placed({{5, 3, 1, 0}}) ==
        Messages{"fill.file: grain 1 the radius must be positive and at most 10000, is 0"});
  CHECK(placed({{nan, 3, 1, 0.5}}).size() == 1);
  CHECK(placed({{5, nan, 1, 0.5}}).size() == 1);
  CHECK(placed({{5, 3, nan, 0.5}}).size() == 1);
  CHECK(placed({{5, 3, 1, nan}}).size() == 1);
}

TEST_CASE("placed grains lie in the tube, and no higher than a bed may be long") {
  const auto placed = [](const Box& box, const PlacedSphere& grain) {
    return broken_by([=](PackingSpec& spec) {
             spec.box = box;
             spec.fill = PlacedGrains{{grain}};
           })
        .size();
  };
  CHECK(placed(tube_of(4), {0.5, 2, 1, 0.5}) == 0);
  CHECK(placed(tube_of(4), {0.495, 2, 1, 0.5}) == 0);  // overlaps the wall as a settled bed may
  CHECK(placed(tube_of(4), {0.48, 2, 1, 0.5}) == 1);
  CHECK(placed({10, 6}, {5, 3, 10'000, 0.5}) == 0);
  CHECK(placed({10, 6}, {5, 3, 10'001, 0.5}) == 1);
}

TEST_CASE("placed polyhedra may lie on their faces, turned as unit quaternions say") {
  const auto placed = [](const std::array<double, 4>& last) {
    return broken_by([=](PackingSpec& spec) {
      spec.box = {10, 6};
      spec.shape = CuboidSize{1, 0.2, 0.2};
      spec.fill = PlacedGrains{{{5, 0.1, 0.1, 0.5}, {2, 3, 1, 0.5}}, {{0, 0, 0, 1}, last}};
    });
  };
  CHECK(placed({0, 0, 1, 0}).empty());
  const Messages errors = placed({0, 0, 1, 1});
  REQUIRE(errors.size() == 1);
  CHECK(errors[0].starts_with("fill.file: grain 2 qx, qy, qz, qw must be a unit quaternion"));
}

TEST_CASE("a placed grain of a mixture is of one of its components") {
  const auto placed = [](std::uint8_t component) {
    return broken_by([=](PackingSpec& spec) {
      spec.shape = Mixture{{{0.5, CubeSize{}}, {0.5, SphereShape{}}}};
      PlacedGrains grains{{{5, 3, 1, 0.5}}, {{0, 0, 0, 1}}};
      grains.components = {component};
      spec.fill = grains;
    });
  };
  CHECK(placed(1).empty());
  CHECK(placed(2).size() == 1);
}

TEST_CASE(
    "placed grains of a mixture are as large as their components, whatever shares these have") {
  const auto placed = [](double side, double z, std::uint8_t component) {
    return broken_by([=](PackingSpec& spec) {
      spec.box = {side, side, Boundary::periodic, Boundary::periodic};
      spec.shape = Mixture{{{1.0, SphereShape{}}, {0.0, CuboidSize{3, 0.5, 0.5}}}};
      PlacedGrains grains{{{2, 2, z, 0.5}}, {{0, 0, 0, 1}}};
      grains.components = {component};
      spec.fill = grains;
    });
  };
  CHECK(placed(4.5, 0.5, 0).empty());
  const Messages errors = placed(4.5, 0.5, 1);
  REQUIRE(errors.size() == 2);
  CHECK(errors[0].starts_with("box.length: must lie in [6.56"));  // twice 3.082 and the margin
  CHECK(placed(7, 0.25, 1).empty());                              // lies on a long face
  CHECK(placed(7, 0.25, 0).size() == 1);
}

TEST_CASE("the least value that an error names is right") {
  for (const double cube : {1.13, 1.31, 0.9, 0.777}) {
    for (const bool is_tube : {false, true}) {
      const auto errors_at = [&](double side) {
        return check(changed([&](PackingSpec& spec) {
          spec.shape = CubeSize{cube};
          spec.box =
              is_tube ? tube_of(side) : Box{side, side, Boundary::periodic, Boundary::periodic};
        }));
      };
      const std::string message = errors_at((is_tube ? 3.0 : 0.5) * cube).front().message;
      INFO(message);
      const std::size_t number = message.find_first_of("0123456789");
      REQUIRE(number != std::string::npos);
      const double least = std::stod(message.substr(number));
      CHECK(errors_at(least).empty());
      CHECK(!errors_at(least * (1.0 - 2e-5)).empty());  // six digits
    }
  }
}

TEST_CASE("grains of a file that are far smaller than d have the wrong unit") {
  PackingSpec spec;
  PlacedGrains placed;
  for (int k = 0; k < 9; ++k) placed.grains.push_back({0.01 + 0.02 * k, 0.01, 0.01, 0.01});
  spec.fill = placed;
  const auto errors = check(spec);
  REQUIRE(errors.size() == 1);
  CHECK(errors[0].path == "fill.file");
  CHECK(errors[0].message.starts_with("gives a bed too low to be measured: at most 0.02"));
  CHECK(errors[0].message.ends_with("fill.diameter, the length in the file that is d, is wrong"));
}

TEST_CASE("a bed that must come out too low to be measured is refused where it is filled") {
  const auto bed = [](double width, const Fill& fill, double exclude_floor) {
    return broken_by([=](PackingSpec& spec) {
      spec.box.width = width;
      spec.fill = fill;
      spec.measure.exclude_floor = exclude_floor;
    });
  };
  // At 0.5, below which no bed of spheres in a wide box stays, 2 d of solid are 4 d high, and the
  // highest grain stands out by its diameter.
  const std::string reason =
      ": gives a bed too low to be measured: at most 5 d high, and measure.exclude_floor, "
      "measure.exclude_surface and a slab of 1 d between them take ";
  CHECK(bed(10, SolidHeight{3}, 3).empty());
  CHECK(bed(10, SolidHeight{2}, 3) == Messages{"fill.solid_height" + reason +
                                               "7 d; give fill.solid_height 4.62 or more, or "
                                               "leave less out"});
  CHECK(bed(10, SolidHeight{2}, 1).empty());
  CHECK(bed(1.5, SolidHeight{2}, 3).empty());  // 0.45 is reached here
  CHECK(bed(10, SolidHeight{2}, 20) == Messages{"measure" + reason +
                                                "24 d; give fill.solid_height 15.8 or more, or "
                                                "leave less out"});
  REQUIRE(bed(10, GrainCount{3}, 3).size() == 1);
  CHECK(bed(10, GrainCount{3}, 3)[0].starts_with("fill.grains: gives a bed too low"));
  CHECK_THAT(bed(10, GrainCount{3}, 3)[0], Catch::EndsWith(" or more, or leave less out"));
}

TEST_CASE("what is enough to fill in makes a bed that is measured") {
  PackingSpec spec;
  for (const Fill& fill : {Fill(GrainCount{50}), Fill(SolidHeight{1})}) {
    spec.fill = fill;
    CHECK_FALSE(check(spec).empty());
    const std::string enough = enough_fill(spec);
    const double number = std::stod(enough.substr(enough.find(' ')));
    if (std::holds_alternative<GrainCount>(fill)) {
      CHECK_THAT(enough, Catch::StartsWith("fill.grains "));
      spec.fill = GrainCount{static_cast<std::int64_t>(number)};
    } else {
      CHECK_THAT(enough, Catch::StartsWith("fill.solid_height "));
      spec.fill = SolidHeight{number};
    }
    CHECK(check(spec).empty());
    CHECK(probable_height(spec) == Approx(1.1 * 7.0).epsilon(0.01));
  }
  spec.fill = PlacedGrains{{{1, 1, 1, 0.5}}};
  CHECK(enough_fill(spec).empty());
}

TEST_CASE("a shape so small that too many of it fill the box is to blame") {
  PackingSpec spec;
  spec.shape = CylinderSize{0.005, 0.005};
  const auto errors = check(spec);
  REQUIRE(errors.size() == 1);
  CHECK(errors[0].path == "shape.cylinder");
  CHECK_THAT(errors[0].message,
             Catch::StartsWith("gives grains of 0.00707 d across, ") &&
                 Catch::EndsWith("; lengths are in d, a large grain's mean diameter"));
}

TEST_CASE("layers do not interlock in narrow tubes nor between end walls: beds may be higher") {
  const auto bed = [](const Box& box, const ShapeSpec& shape) {
    return broken_by([=](PackingSpec& spec) {
             spec.box = box;
             spec.shape = shape;
             spec.fill = SolidHeight{2};
             spec.measure.exclude_floor = 3;
           })
        .size();
  };
  CHECK(bed(tube_of(2.45), {}) == 0);  // 2 / 0.3 and a grain high, of 7 d
  CHECK(bed(tube_of(2.55), {}) == 1);
  CHECK(bed({3.4, 10, Boundary::walls, Boundary::walls}, CubeSize{}) == 0);  // of 1.73 d
  CHECK(bed({3.5, 10, Boundary::walls, Boundary::walls}, CubeSize{}) == 1);
}

TEST_CASE("beds come out as high as most do") {
  PackingSpec spec;
  spec.sizes.spread = 0.0;
  spec.box = {10, 10, Boundary::periodic, Boundary::periodic};
  spec.fill = SolidHeight{6};
  CHECK(probable_height(spec) == Approx(6 / 0.6));
  spec.shape = CubeSize{};
  CHECK(probable_height(spec) == Approx(6 / 0.62));
}

TEST_CASE("tubes hold polyhedra of any size that may occur") {
  const auto tube = [](double largest) {
    return broken_by([=](PackingSpec& spec) {
      spec.box = tube_of(6);
      spec.shape = CubeSize{};
      spec.sizes.distribution = SizeDistribution{.formula = UniformSizes{0.9, largest}};
    });
  };
  CHECK(tube(1.3).empty());  // 2.5 times 1.73 times 1.3: 5.63 d
  const Messages errors = tube(1.5);
  REQUIRE(errors.size() == 1);
  CHECK(errors[0].starts_with("tube.diameter: must be at least 6.49"));
}

TEST_CASE("the narrowest tube of polyhedra follows the size that they have") {
  const auto is_right = [](double diameter, const auto& change) {
    return broken_by([&](PackingSpec& spec) {
             spec.box = tube_of(diameter);
             spec.shape = CubeSize{};
             change(spec);
           })
        .empty();
  };
  const auto all_small = [](PackingSpec& spec) {
    spec.sizes.small_share = 1.0;
    spec.sizes.size_ratio = 0.5;
  };
  CHECK(is_right(2.2, all_small));  // 2.5 times 0.866: 2.17 d
  CHECK(!is_right(2.1, all_small));
  for (const double size : {0.5, 2.0}) {
    const auto placed = [size](PackingSpec& spec) {
      const double axis = spec.box.length / 2.0;
      spec.fill = PlacedGrains{{{axis, axis, size / 2.0, size / 2.0}}, {{0, 0, 0, 1}}};
    };
    CHECK(is_right(4.3 * size, placed));  // 0.99 times 2.5 times 1.732: 4.29
    CHECK(!is_right(4.2 * size, placed));
  }
}

TEST_CASE("steps in which a bed cannot even fall are refused") {
  const auto steps = [](double step, double momentum, Protocol protocol) {
    return broken_by([=](PackingSpec& spec) {
      spec.sizes.spread = 0.0;
      spec.fill = SolidHeight{8};  // from 32 d high to 16
      spec.accuracy.step = step;
      spec.accuracy.momentum = momentum;
      spec.accuracy.protocol = protocol;
      spec.accuracy.max_steps = 1000;
    });
  };
  // Damped grains fall step^2 / (1 - momentum) a step at most, free ones 16 d in sqrt(32).
  CHECK(steps(0.0401, 0.9, Protocol::heavy_ball).empty());
  CHECK(steps(0.0399, 0.9, Protocol::heavy_ball) ==
        Messages{"accuracy: cannot come to rest: in steps of 0.0399 the fall alone takes 1.01e+03 "
                 "of them, "
                 "max_steps is 1000"});
  CHECK(steps(0.0057, 0.9, Protocol::dynamic).empty());
  CHECK(steps(0.0056, 0.9, Protocol::dynamic).size() == 1);
  CHECK(steps(0.127, 0.0, Protocol::heavy_ball).empty());
  const auto most = [](int max_steps) {
    return broken_by([=](PackingSpec& spec) {
      spec.sizes.spread = 0.0;
      spec.fill = SolidHeight{8};
      spec.accuracy.step = 0.127;
      spec.accuracy.momentum = 0.0;
      spec.accuracy.max_steps = max_steps;
    });
  };
  CHECK(most(993).empty());  // 16 / 0.127^2 is 992.002
  CHECK(most(992).size() == 1);
  CHECK(steps(0.126, 0.0, Protocol::heavy_ball).size() == 1);
}

TEST_CASE("a bed that is too high to fall at any usual accuracy is the fault of its fill") {
  // 10 million spheres of volume pi/6 over 16 d^2.
  const Messages said = broken_by([](PackingSpec& spec) {
    spec.sizes.spread = 0.0;
    spec.box.length = spec.box.width = 4.0;
    spec.fill = GrainCount{10'000'000};
  });
  CHECK(
      said ==
      Messages{"fill.grains: gives a bed too high to come to rest, 3.27e+05 d of solid: in steps "
               "of 0.2 the fall alone takes 1.64e+06 of them, max_steps is 20000; fill in less, or "
               "widen the box"});
}

TEST_CASE("a hull far from d in size is told to have the wrong unit") {
  const auto hull = [](double size) {
    return broken_by([=](PackingSpec& spec) {
      spec.shape = HullVertices{{{0, 0, 0}, {size, 0, 0}, {0, size, 0}, {0, 0, size}}};
    });
  };
  CHECK(hull(1.5).empty());
  for (const double size : {1e-9, 40.0}) {
    REQUIRE_FALSE(hull(size).empty());
    CHECK(hull(size)[0].find("shape.hull.size, the length in its vertices that is d, is missing") !=
          std::string::npos);
  }
  CHECK(
      hull(1e-9)[0].starts_with("fill.solid_height: must give 1 to 10000000 grains, gives 1e+17"));
}

TEST_CASE("grains that no container has room for are wrong, not the container") {
  const auto said = broken_by([](PackingSpec& spec) { spec.shape = CubeSize{8000}; });
  REQUIRE(said.size() == 1);
  CHECK(said[0] ==
        "shape.cube: gives grains of 1.57e+04 d across, and containers are at most 10000 d long; "
        "lengths are in d, a large grain's mean diameter");
}

TEST_CASE("sizes keep to their intervals") {
  const auto sizes = [](SizesSpec changed_sizes, std::int64_t grains = 1'000'000) {
    return broken_by([=](PackingSpec& spec) {
      spec.sizes = changed_sizes;
      spec.fill = GrainCount{grains};
      spec.measure.exclude_floor = spec.measure.exclude_surface = 0.0;
    });
  };
  CHECK(sizes({0.0, 0.0, 1.0}).empty());
  CHECK(sizes({0.2, 1.0, 0.05}, 10'000'000).empty());
  CHECK(sizes({-0.01, 0.0, 0.5}) == Messages{"sizes.spread: must lie in [0, 0.2], is -0.01"});
  CHECK(sizes({0.21, 0.0, 0.5}) == Messages{"sizes.spread: must lie in [0, 0.2], is 0.21"});
  const std::string percent = "; divide percentages by 100";
  CHECK(sizes({3, 0.0, 0.5}) == Messages{"sizes.spread: must lie in [0, 0.2], is 3" + percent});
  CHECK(sizes({0, 30, 0.5}) == Messages{"sizes.small_share: must lie in [0, 1], is 30" + percent});
  CHECK(sizes({0.1, 101, 0.5}) == Messages{"sizes.small_share: must lie in [0, 1], is 101"});
  CHECK(sizes({0.1, 0.0, 2}) == Messages{"sizes.size_ratio: must lie in (0.02, 1], is 2"});
  CHECK(sizes({0.1, 1.4, 0.5}) == Messages{"sizes.small_share: must lie in [0, 1], is 1.4"});
  CHECK(sizes({0.1, 0.5, 0.02}) == Messages{"sizes.size_ratio: must lie in (0.02, 1], is 0.02"});
  CHECK(sizes({nan, nan, nan}) == Messages{"sizes.spread: must lie in [0, 0.2], is nan",
                                           "sizes.small_share: must lie in [0, 1], is nan",
                                           "sizes.size_ratio: must lie in (0.02, 1], is nan"});
}

TEST_CASE("every part of the accuracy keeps to its interval") {
  const auto accuracy = [](auto change) {
    const auto broken = broken_by([&](PackingSpec& spec) { change(spec.accuracy); });
    REQUIRE(broken.size() == 1);
    return broken[0];
  };
  CHECK(accuracy([](Accuracy& a) { a.step = 0; }) ==
        "accuracy.step: must lie in [0.0001, 2], is 0");
  CHECK(accuracy([](Accuracy& a) { a.step = nan; }) ==
        "accuracy.step: must lie in [0.0001, 2], is nan");
  CHECK(accuracy([](Accuracy& a) { a.momentum = 1; }) ==
        "accuracy.momentum: must lie in [0, 1), is 1");
  CHECK(accuracy([](Accuracy& a) { a.fall_iterations = 0; }) ==
        "accuracy.fall_iterations: must lie in [1, 1000000], is 0");
  CHECK(accuracy([](Accuracy& a) { a.rest_iterations = 1'000'001; }) ==
        "accuracy.rest_iterations: must lie in [1, 1000000], is 1000001");
  CHECK(accuracy([](Accuracy& a) { a.path_tolerance = 1e-12; }) ==
        "accuracy.path_tolerance: must be at least 1e-09, is 1e-12");
  CHECK(accuracy([](Accuracy& a) { a.residual_tolerance = 0; }) ==
        "accuracy.residual_tolerance: must be positive, is 0");
  CHECK(accuracy([](Accuracy& a) { a.contact_tolerance = -1; }) ==
        "accuracy.contact_tolerance: must be positive, is -1");
  CHECK(accuracy([](Accuracy& a) { a.overlap_tolerance = nan; }) ==
        "accuracy.overlap_tolerance: must be positive, is nan");
  CHECK(accuracy([](Accuracy& a) { a.overlap_tolerance = infinity; }) ==
        "accuracy.overlap_tolerance: must be positive, is inf");
  CHECK(accuracy([](Accuracy& a) { a.max_steps = 0; }) ==
        "accuracy.max_steps: must be at least 1, is 0");
}

TEST_CASE("excluded zones and gap tolerances keep to their intervals") {
  const auto tolerances = [](std::vector<double> list) {
    return broken_by([&](PackingSpec& spec) { spec.measure.gap_tolerances = std::move(list); });
  };
  CHECK(tolerances({1e-4}).empty());
  CHECK(tolerances({}) == Messages{"measure.gap_tolerances: must hold 1 to 8 tolerances, holds 0"});
  CHECK(tolerances(std::vector<double>(9, 1e-4)) ==
        Messages{"measure.gap_tolerances: must hold 1 to 8 tolerances, holds 9"});
  CHECK(tolerances({1e-4, 0.0, 0.1}) ==
        Messages{"measure.gap_tolerances: must lie in (0, 0.1), is 0",
                 "measure.gap_tolerances: must lie in (0, 0.1), is 0.1"});
  CHECK(tolerances({1e-4, 1e-5, 1e-4}) ==
        Messages{"measure.gap_tolerances: must hold distinct tolerances, holds 0.0001 twice"});
  CHECK(broken_by([](PackingSpec& spec) {
          spec.measure.exclude_floor = -1;
          spec.measure.exclude_surface = nan;
        }) == Messages{"measure.exclude_floor: must lie in [0, 1000], is -1",
                       "measure.exclude_surface: must lie in [0, 1000], is nan"});
}

TEST_CASE("the bins of a profile are no wider than the box") {
  const auto bins = [](double width) {
    return broken_by([&](PackingSpec& spec) {
      spec.box.width = 5;
      spec.measure.bin_width = width;
    });
  };
  CHECK(bins(5).empty());
  CHECK(bins(0.01).empty());
  const std::string rule = "measure.bin_width: must lie in [0.01, 5] (no wider than box.width), ";
  CHECK(bins(5.5) == Messages{rule + "is 5.5"});
  CHECK(bins(0) == Messages{rule + "is 0"});
  CHECK(bins(nan) == Messages{rule + "is nan"});
  const auto rings = [](double width) {
    return broken_by([&](PackingSpec& spec) {
      spec.box = tube_of(5);
      spec.measure.bin_width = width;
    });
  };
  CHECK(rings(2.5).empty());
  CHECK(rings(2.6) == Messages{"measure.bin_width: must lie in [0.01, 2.5] (no wider than half of "
                               "tube.diameter), is 2.6"});
}

TEST_CASE("two sizes whose masses differ by more than 1e5 to 1 take f64") {
  PackingSpec spec;
  spec.sizes = {0.0, 1e-4, 0.0205};
  const auto errors = check(spec);
  REQUIRE(errors.size() == 1);
  CHECK(errors[0].path == "sizes.size_ratio");
  spec.accuracy.precision = Precision::f64;
  CHECK(check(spec).empty());
  spec.accuracy.precision = Precision::f32;
  spec.sizes.size_ratio = 0.022;
  CHECK(check(spec).empty());
}

TEST_CASE("placed grains whose masses differ by more than 1e5 to 1 take f64") {
  PackingSpec spec;
  spec.fill = PlacedGrains{{{1, 1, 0.5, 0.5}, {3, 3, 0.01, 0.01}}};
  const auto errors = check(spec);
  REQUIRE(errors.size() == 1);
  CHECK(errors[0].path == "fill.file");
  CHECK(errors[0].message.starts_with("has grains of 1.25e+05 times each other's mass"));
  spec.accuracy.precision = Precision::f64;
  CHECK(check(spec).empty());
  spec.accuracy.precision = Precision::f32;
  std::get<PlacedGrains>(spec.fill).grains[1].radius = 0.011;
  CHECK(check(spec).empty());
}

TEST_CASE("grains of a file with a wrong diameter are told so, however small they come out") {
  PackingSpec spec;
  spec.fill = PlacedGrains{{{1, 1, 0.1, 1e-300}, {3, 3, 0.1, 5e-301}}};
  const auto errors = check(spec);
  REQUIRE(errors.size() == 1);
  CHECK(errors[0].path == "fill.file");
  CHECK(errors[0].message.find("is wrong") != std::string::npos);
  CHECK(errors[0].message.find("mass") == std::string::npos);
}

TEST_CASE("the masses of a mixture's placed grains are those of their components") {
  PackingSpec spec;
  spec.shape = Mixture{{{0.5, CubeSize{}}, {0.5, CubeSize{0.1}}}, ShareBy::number};
  PlacedGrains placed{{{2, 2, 1, 0.5}, {4, 4, 1, 0.1}}, {{0, 0, 0, 1}, {0, 0, 0, 1}}, {0, 1}};
  spec.fill = placed;  // 1000 times the volume, and 5 times the size
  const auto errors = check(spec);
  REQUIRE(errors.size() == 1);
  CHECK(errors[0].message.starts_with("has grains of 1.25e+05 times each other's mass"));
  placed.components = {1, 0};  // 1000 over 125
  spec.fill = placed;
  CHECK(check(spec).empty());
}

TEST_CASE("a hull has at most a thousand vertices") {
  const auto ball_of = [](std::size_t vertices) {
    HullVertices hull;
    for (std::size_t k = 0; k < vertices; ++k) {  // on a spiral from pole to pole
      const double z = 1.0 - (2.0 * static_cast<double>(k) + 1.0) / static_cast<double>(vertices);
      const double turn = 2.4 * static_cast<double>(k), across = std::sqrt(1.0 - z * z);
      hull.points.push_back(
          {0.5 * across * std::cos(turn), 0.5 * across * std::sin(turn), 0.5 * z});
    }
    PackingSpec spec;
    spec.shape = hull;
    return check(spec);
  };
  CHECK(ball_of(most_vertices_of_a_grain).empty());
  const auto errors = ball_of(most_vertices_of_a_grain + 1);
  REQUIRE(errors.size() == 1);
  CHECK(errors[0].path == "shape.hull");
  CHECK(errors[0].message == "must have at most 1000 vertices, has 1001");
}

TEST_CASE("the box of a tube is as wide as long and has walls all around") {
  const auto broken = [](const Box& box) {
    return broken_by([&](PackingSpec& spec) { spec.box = box; });
  };
  CHECK(broken(tube_of(5)).empty());
  const Messages wrong{
      "tube.diameter: must be both the length and the width of the tube's box, "
      "which has walls on all sides"};
  Box oval = tube_of(5), open = tube_of(5);
  oval.width = 6;
  CHECK(broken(oval) == wrong);
  open.x = Boundary::periodic;
  CHECK(broken(open) == wrong);
}

TEST_CASE("components whose masses differ by more than 1e5 to 1 take f64") {
  PackingSpec spec;
  spec.shape = Mixture{{{0.999, CubeSize{}}, {0.001, CubeSize{0.02}}}, ShareBy::volume};
  spec.fill = GrainCount{200'000};  // of which nearly all are small
  const auto errors = check(spec);
  REQUIRE(errors.size() == 1);
  CHECK(errors[0].path == "shape.mixture");
  CHECK(errors[0].message.starts_with("has components of 1.25e+05 times each other's volume"));
  spec.accuracy.precision = Precision::f64;
  CHECK(check(spec).empty());
  spec.accuracy.precision = Precision::f32;
  spec.shape = Mixture{{{1.0, CubeSize{}}, {0.0, CubeSize{0.02}}}, ShareBy::volume};
  spec.fill = GrainCount{2000};
  CHECK(check(spec).empty());  // none of the small ones is drawn
}

TEST_CASE("beds of needles may come out looser than those of stout grains") {
  const auto bed = [](const CuboidSize& size) {
    return broken_by([=](PackingSpec& spec) {
      spec.shape = size;
      spec.box.width = 10;
      spec.fill = SolidHeight{2};
    });
  };
  CHECK(bed({1, 1, 1}).size() == 1);  // at most 2 / 0.4 and an extent high, of 7 d
  CHECK(bed({1, 0.05, 0.05}).empty());
}

TEST_CASE("exact rest is for spheres of any sizes") {
  const auto exact = [](const ShapeSpec& shape) {
    return broken_by([&](PackingSpec& spec) {
      spec.shape = shape;
      spec.sizes.small_share = 0.3;
      spec.accuracy.rest = Rest::exact;
    });
  };
  CHECK(exact({}).empty());
  CHECK(exact(PinacoidSize{}) ==
        Messages{
            "accuracy.rest: must be in_steps for grains that are not spheres, is exact; accurate "
            "is the preset that settles them best"});
}

TEST_CASE("exact rest takes some room between walls that hold all grains of one size") {
  const auto exact = [](double width, double spread) {
    return broken_by([&](PackingSpec& spec) {
      spec.box.width = width;
      spec.sizes.spread = spread;
      spec.accuracy.rest = Rest::exact;
    });
  };
  CHECK(exact(1.0, 0.0) ==
        Messages{"accuracy.rest: must be in_steps where walls are nearer than 1.005 d and hold "
                 "every large grain on both sides, is exact"});
  CHECK(exact(1.01, 0.0).empty());
  CHECK(exact(1.0000001, 1e-12).size() == 1);
  CHECK(broken_by([](PackingSpec& spec) {  // the same grains as a distribution
          spec.box.width = 1.0;
          spec.sizes.distribution = SizeDistribution{.formula = SizeTable{{1.0}, {}, {1.0}}};
          spec.accuracy.rest = Rest::exact;
        })
            .size() == 1);
  CHECK(exact(1.1333334, 0.0333333).empty());
}

TEST_CASE("a solid height asks for its volume over that of a mean grain") {
  PackingSpec spec;
  spec.box.length = 10.0;
  spec.box.width = 6.0;
  spec.sizes.spread = 0.0;
  spec.fill = SolidHeight{3.141592653589793};
  CHECK(grain_count(spec) == 360);  // pi 60 / (pi / 6)
  spec.sizes = {0.0, 0.5, 0.5};
  CHECK(grain_count(spec) == 180 + 8 * 180);
  spec.fill = GrainCount{77};
  CHECK(grain_count(spec) == 77);
  spec.fill = PlacedGrains{{{1, 1, 1, 0.5}, {3, 3, 1, 0.5}}};
  CHECK(grain_count(spec) == 2);
}

}  // namespace grainsweep
