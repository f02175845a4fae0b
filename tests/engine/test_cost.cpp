#include <cmath>

#include <catch2/catch.hpp>

#include "engine/cost.hpp"
#include "engine/dynamics/presets.hpp"

namespace grainsweep {
namespace {

PackingSpec thousand_spheres() {
  PackingSpec spec;
  spec.box = {8, 8, Boundary::periodic, Boundary::walls};
  spec.fill = GrainCount{1000};
  spec.accuracy = *preset("fast");
  return spec;
}

double seconds(const PackingSpec& spec) { return estimate_cost(spec).cpu_seconds; }

// Measured in separate processes: 366 MB of 4000 spheres in 10 d by 10 d.
TEST_CASE("exact rest has memory for the factors of a bed's stiffness") {
  PackingSpec spec = thousand_spheres();
  spec.box = {10, 10, Boundary::periodic, Boundary::walls};
  spec.fill = GrainCount{4000};
  const double in_steps = estimate_cost(spec).bytes;
  spec.accuracy.rest = Rest::exact;
  CHECK(estimate_cost(spec).bytes - in_steps > 200e6);
  CHECK(estimate_cost(spec).bytes - in_steps < 800e6);
}

TEST_CASE("few grains that are tiny have no more pairs than there are") {
  PackingSpec spec = thousand_spheres();
  PlacedGrains placed;
  for (int k = 0; k < 500; ++k) placed.grains.push_back({1.0 + 0.01 * k, 4.0, 1.0, 1e-6});
  spec.fill = placed;
  CHECK(estimate_cost(spec).bytes < 50e6);
}

// Measured: 400 spheres at `fast` take 0.04 s in tubes of 1.5 to 1.66 d, 1.4 s in one of 1.75 d and
// 0.45 s in one of 1.95 d; equal ones take 0.05 s in that of 1.75 d.
TEST_CASE("spheres that lean from side to side of a tube take longer where they come near others") {
  PackingSpec spec = thousand_spheres();
  spec.fill = GrainCount{400};
  const auto in_tube = [&](double diameter) {
    spec.box = tube_of(diameter);
    return seconds(spec);
  };
  CHECK(in_tube(1.75) > 5.0 * in_tube(1.6));
  CHECK(in_tube(1.75) > 5.0 * in_tube(1.95));
  CHECK(in_tube(1.75) > 0.7);
  CHECK(in_tube(1.75) < 2.8);
  spec.sizes.spread = 0.0;
  CHECK(in_tube(1.75) == Approx(in_tube(1.6)).epsilon(0.15));  // the bed is lower, too
}

// Measured: 333 spheres at `fast` take 4.6 times as long in steps of 0.02 as in those of 0.2.
TEST_CASE("a fall in short steps takes more of them") {
  PackingSpec spec = thousand_spheres();
  const double usual = seconds(spec);
  spec.accuracy.step = 0.02;
  CHECK(seconds(spec) > 2.3 * usual);
  CHECK(seconds(spec) < 9.2 * usual);
}

// Measured: 15228 spheres take 157 iterations a step.
TEST_CASE("a path that no step can keep to costs the iterations that a step may take") {
  PackingSpec spec = thousand_spheres();
  spec.accuracy.path_tolerance = 1e-6;
  const double all = seconds(spec);
  spec.accuracy.path_tolerance = 1e-9;
  CHECK(seconds(spec) == all);
  spec.accuracy.path_tolerance = 5e-5;
  CHECK(seconds(spec) < 0.5 * all);
}

TEST_CASE("the cost of a packing grows with its grains and its accuracy") {
  PackingSpec spec = thousand_spheres(), larger = spec, finer = spec, wider = spec, exact = spec;
  larger.fill = GrainCount{4000};
  larger.box.length *= 4.0;
  finer.accuracy = *preset("accurate");
  wider.accuracy.precision = Precision::f64;
  exact.accuracy = *preset("exact");
  CHECK(seconds(larger) == Approx(4 * seconds(spec)));
  CHECK(estimate_cost(larger).bytes > estimate_cost(spec).bytes);
  CHECK(seconds(finer) > 2 * seconds(spec));
  CHECK(seconds(wider) > seconds(spec));
  CHECK(seconds(exact) > seconds(finer));
}

TEST_CASE("exact rest costs less in a tower than in a bed as wide as high") {
  PackingSpec wide = thousand_spheres(), tower = wide;
  wide.box.length = wide.box.width = 10.0;
  tower.box.length = tower.box.width = 5.0;
  const auto of_search = [](PackingSpec spec) {
    spec.accuracy = *preset("exact");
    const double whole = seconds(spec);
    spec.accuracy.rest = Rest::in_steps;
    return whole - seconds(spec);
  };
  CHECK(of_search(wide) > 2 * of_search(tower));
}

// Kinds as of bench/costs.sh.
TEST_CASE("polyhedra and hulls of many corners cost more than spheres of one size") {
  PackingSpec spec = thousand_spheres(), pinacoids = spec, cubes = spec, round = spec;
  pinacoids.shape = PinacoidSize{};
  cubes.shape = CubeSize{};
  round.shape = PrismSize{40, 1, 1};  // of 80 corners, four times as many as are usual
  CHECK(seconds(cubes) > seconds(pinacoids));
  CHECK(seconds(pinacoids) > seconds(spec));
  CHECK(seconds(round) == Approx(std::pow(4.0, 0.6) * seconds(cubes)));
}

TEST_CASE("flat and long polyhedra cost more than stout ones of as many corners") {
  PackingSpec stout = thousand_spheres(), flat = stout, cubes = stout, plates = stout;
  stout.shape = PinacoidSize{};
  flat.shape = PinacoidSize{1, 1, 0.3};
  cubes.shape = CubeSize{};
  plates.shape = CuboidSize{1, 1, 0.1};
  CHECK(seconds(flat) > 1.5 * seconds(stout));
  CHECK(seconds(plates) > 2 * seconds(cubes));
}

TEST_CASE("a mixture costs what its components do, weighted by their numbers") {
  PackingSpec cubes = thousand_spheres(), prisms = cubes, mixed = cubes;
  cubes.shape = CubeSize{};
  prisms.shape = PrismSize{40, 1, 1};
  mixed.shape = Mixture{{{0.25, cubes.shape}, {0.75, prisms.shape}}, ShareBy::number};
  CHECK(seconds(mixed) == Approx(0.25 * seconds(cubes) + 0.75 * seconds(prisms)));
  PackingSpec pinacoids = cubes;
  pinacoids.shape = PinacoidSize{};
  mixed.shape = Mixture{{{0.5, PinacoidSize{}}, {0.5, PinacoidSize{}}}};
  CHECK(seconds(mixed) == Approx(seconds(pinacoids)));
  PackingSpec flat = pinacoids, balls = pinacoids;
  flat.shape = PinacoidSize{1, 1, 0.5};
  mixed.shape = Mixture{{{0.5, pinacoids.shape}, {0.5, flat.shape}}, ShareBy::number};
  CHECK(seconds(mixed) == Approx(0.5 * seconds(pinacoids) + 0.5 * seconds(flat)));
  balls.shape = Mixture{{{0.5, SphereShape{}}, {0.5, SphereShape{}}}};
  CHECK(seconds(balls) < 0.7 * seconds(pinacoids));
  mixed.shape = Mixture{{{0.5, pinacoids.shape}, {0.5, SphereShape{}}}, ShareBy::number};
  CHECK(seconds(mixed) == Approx(0.5 * seconds(pinacoids) + 0.5 * seconds(balls)));
}

TEST_CASE("grains of several sizes cost more than as many of one, however the sizes are given") {
  PackingSpec one = thousand_spheres(), two = one, drawn = one, placed = one;
  two.sizes = {0.0, 0.5, 0.5};
  // The same two sizes as a table by volume, and one by one: an eighth of the grains are large.
  drawn.sizes.distribution = {SizeTable{{0.5, 1.0}, {}, {0.5, 0.5}}, SizeWeight::volume};
  PlacedGrains grains;
  for (int i = 0; i < 900; ++i) grains.grains.push_back({0, 0, 0, i < 100 ? 0.5 : 0.25});
  placed.fill = grains;
  for (const char* name : {"fast", "balanced", "accurate"}) {
    for (PackingSpec* spec : {&one, &two, &drawn, &placed}) spec->accuracy = *preset(name);
    one.fill = two.fill = drawn.fill = SolidHeight{10.0};
    CHECK(seconds(two) > 4 * seconds(one));
    CHECK(seconds(drawn) == Approx(seconds(two)).epsilon(0.02));
    two.fill = GrainCount{900};
    CHECK(seconds(placed) == Approx(seconds(two)).epsilon(0.02));
  }
}

TEST_CASE("small grains, which have many others around them, take more memory") {
  PackingSpec one = thousand_spheres(), small = one;
  small.sizes = {0.0, 0.5, 0.05};
  CHECK(estimate_cost(small).bytes - estimate_cost(one).bytes > 3e6);
  PackingSpec pinacoids = one;
  pinacoids.shape = PinacoidSize{};
  CHECK(estimate_cost(pinacoids).bytes > estimate_cost(one).bytes);
}

}  // namespace
}  // namespace grainsweep
