#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include <catch2/catch.hpp>

#include "engine/dynamics/inertia.hpp"
#include "engine/dynamics/presets.hpp"
#include "engine/dynamics/stages.hpp"

namespace grainsweep {
namespace {

/// The stage of that name; there must be one.
const StageRule& stage_called(std::string_view name, Stages stages) {
  const auto found = std::find_if(stages.begin(), stages.end(),
                                  [&](const StageRule& stage) { return stage.name == name; });
  REQUIRE(found != stages.end());
  return *found;
}
const StageRule& heavy_ball(std::string_view name) {
  return stage_called(name, stages_of<Sphere>(Protocol::heavy_ball));
}
const StageRule& dynamic(std::string_view name) {
  return stage_called(name, stages_of<Sphere>(Protocol::dynamic));
}

std::array<Stages, 4> all_stages() {
  return {stages_of<Sphere>(Protocol::heavy_ball), stages_of<Sphere>(Protocol::dynamic),
          stages_of<Polyhedron>(Protocol::heavy_ball), stages_of<Polyhedron>(Protocol::dynamic)};
}

TEST_CASE("every stage has a name of its own among those of its kind") {
  for (const Stages stages : all_stages()) {
    std::set<std::string_view> names;
    for (const StageRule& stage : stages) names.insert(stage.name);
    CHECK(names.size() == stages.size());
    CHECK(names.count("") == 0);
  }
}

TEST_CASE("the share done never falls from stage to stage and stays below 1") {
  for (const Preset& known : presets()) {
    for (const Stages stages : all_stages()) {
      double before = 0;
      for (const StageRule& stage : stages) {
        for (const std::int64_t steps : {0, 1, 10, 1000, 100000}) {
          const double share = share_done(known.accuracy, stage, steps);
          CHECK(share >= before);
          CHECK(share <= 1.0);
          before = share;
        }
      }
      CHECK(before > 0.99);
    }
  }
}

TEST_CASE("every bed is looked at first, and goes on until a test of rest holds") {
  for (const Stages stages : all_stages()) {
    CHECK(stages.front().end == StageEnd::look);
    CHECK(stages.back().end == StageEnd::rest);
    CHECK(stages[stages.size() - 2].end == StageEnd::calm);
  }
}

TEST_CASE("the creep takes its share of the steps that it is given") {
  for (const int steps : {0, 1, 2, 3, 80, 301}) {
    Accuracy accuracy;
    accuracy.creep_steps = steps;
    CHECK(steps_of(accuracy, heavy_ball("creep")) == steps + steps / 4);
  }
  Accuracy accuracy;
  accuracy.creep_steps = 180;
  const Stages turning = stages_of<Polyhedron>(Protocol::heavy_ball);
  CHECK(steps_of(accuracy, stage_called("creep", turning)) == 20 + 90);
  CHECK(steps_of(accuracy, stage_called("slow", turning)) == 40 + 135);
  accuracy.step = 0.05;  // four times as many
  CHECK(steps_of(accuracy, heavy_ball("slow")) == 72);
  // 17 of 0.2 are 200 of 0.017, less one rounding.
  accuracy.creep_steps = 17;
  accuracy.step = 0.017;
  CHECK(steps_of(accuracy, heavy_ball("creep")) == 250);
}

TEST_CASE("half of a stage's share is done after its usual steps") {
  const Accuracy accuracy;
  const std::pair<const char*, std::int64_t> usual[] = {{"look", 40}, {"fall", 90}, {"quench", 20}};
  for (const auto& [name, steps] : usual) {
    const StageRule& stage = heavy_ball(name);
    const double half = (stage.done_before + stage.done_after) / 2;
    CHECK(share_done(accuracy, stage, steps) == Approx(half));
  }
}

TEST_CASE("the longer the creep, the longer the quench") {
  const auto quenched = [](std::string_view name) {
    return steps_of(preset(name).value(), heavy_ball("quench"));
  };
  CHECK(quenched("fast") == 10);
  CHECK(quenched("balanced") == 20);
  CHECK(quenched("accurate") == 40);
  CHECK(quenched("exact") == 40);
}

TEST_CASE(
    "a solve at rest goes on until the test of rest allows what it leaves, or sixteen times") {
  Accuracy accuracy;
  accuracy.residual_tolerance = 2e-3;
  accuracy.rest_iterations = 100;
  const auto limits = [&](const char* stage) {
    return settings_of(accuracy, heavy_ball(stage)).limits;
  };
  const double dt = settings_of(accuracy, heavy_ball("quench")).dt;
  CHECK(limits("quench").residual_cap == Approx(2e-3 * dt * dt));
  CHECK(limits("fall").residual_cap == 0.01);
  accuracy.precision = Precision::f64;
  CHECK(limits("quench").iteration_cap == 16 * 200);
  accuracy.precision = Precision::f32;
  CHECK(limits("quench").iteration_cap == 2 * 200);
  CHECK(limits("fall").iteration_cap == 20'000);
  accuracy.rest_iterations = 9000;
  CHECK(limits("quench").iteration_cap == 20'000);
}

TEST_CASE("iterations of fall and creep are bounded apart from those at rest") {
  Accuracy accuracy;
  accuracy.rest_iterations = 300;
  accuracy.fall_iterations = 77;
  const auto iterations = [&](const StageRule& stage) {
    return settings_of(accuracy, stage).limits.iterations;
  };
  CHECK(iterations(heavy_ball("fall")) == 77);
  CHECK(iterations(heavy_ball("creep")) == 77);
  CHECK(iterations(heavy_ball("quench")) == 600);
  CHECK(iterations(dynamic("fall")) == 77);
  CHECK(iterations(stage_called("fall", stages_of<Polyhedron>(Protocol::heavy_ball))) == 77);
}

TEST_CASE("high beds have sweeps enough at rest for forces to pass from the surface to the floor") {
  Accuracy accuracy;
  accuracy.rest_iterations = 60;
  const auto iterations = [&](const StageRule& stage, double layers) {
    constexpr double height = 40.0;  // d: what counts is how many grains stand one on the other
    return settings_of(accuracy, stage, height, layers).limits.iterations;
  };
  CHECK(iterations(heavy_ball("quench"), 40.0) == 120);
  CHECK(iterations(heavy_ball("quench"), 80.0) == 240);
  CHECK(iterations(stage_called("quench", stages_of<Polyhedron>(Protocol::heavy_ball)), 80.0) ==
        120);
  CHECK(iterations(heavy_ball("ease"), 80.0) == iterations(heavy_ball("ease"), 0.0));
}

TEST_CASE(
    "a step may stray by a path, whatever its length, and half as far where full ones are half") {
  Accuracy accuracy;
  accuracy.path_tolerance = 3e-4;
  const auto path = [&](const StageRule& stage) {
    const StepSettings settings = settings_of(accuracy, stage);
    return settings.limits.rms_tolerance * settings.dt * settings.dt;
  };
  CHECK(path(heavy_ball("fall")) == Approx(6e-4));
  CHECK(path(heavy_ball("creep")) == Approx(8e-5));
  CHECK(path(heavy_ball("quench")) == 0.0);
  accuracy.step = 0.1;
  CHECK(path(heavy_ball("fall")) == Approx(3e-4));
  accuracy.imbalance_gap = 1e-5;
  CHECK(path(heavy_ball("ease")) == Approx(1e-6));
}

TEST_CASE("spheres creep and slide on in steps that are shorter in high beds and stray as far") {
  const Accuracy accuracy;
  for (const char* name : {"creep", "slow", "ease"}) {
    INFO(name);
    const StageRule& stage = heavy_ball(name);
    const StepSettings low = settings_of(accuracy, stage, even_depth);
    const StepSettings high = settings_of(accuracy, stage, 4 * even_depth);
    CHECK(low.dt == stage.step * accuracy.step);
    CHECK(high.dt == Approx(low.dt / 2));
    CHECK(high.limits.rms_tolerance == Approx(4 * low.limits.rms_tolerance));
    CHECK(settings_of(accuracy, stage, 1.0).dt == low.dt);
  }
  for (const char* name : {"look", "fall", "quench"}) {
    INFO(name);
    CHECK(settings_of(accuracy, heavy_ball(name), 4 * even_depth).dt ==
          settings_of(accuracy, heavy_ball(name), even_depth).dt);
  }
}

TEST_CASE("a bed is calm when it moves as little as a net force that it may rest with moves it") {
  Accuracy accuracy;
  accuracy.imbalance_tolerance = 0.01;
  const StageRule& ease = heavy_ball("ease");
  const double pull = 0.01 * std::pow(settings_of(accuracy, ease).dt, 2);
  double motion = 0.0;  // of a grain that the force pulls, damped, in each of many steps
  for (int step = 0; step < 1000; ++step) motion = accuracy.momentum * motion + pull;
  CHECK(calm_motion(accuracy, ease) == Approx(motion));
}

TEST_CASE("in narrow containers steps may stray less far, as the square of how narrow they are") {
  const auto path = [](const Box& box) {
    return closer_where_narrow(*preset("accurate"), box).path_tolerance;
  };
  const double usual = preset("accurate")->path_tolerance;
  CHECK(path({5, 5, periodic, periodic}) == usual);
  CHECK(path({5, 2.5, periodic, periodic}) == Approx(usual / 4));
  CHECK(path({2.5, 9, periodic, walls}) == Approx(usual / 4));
  CHECK(path({5, 5, periodic, walls}) == usual);
  CHECK(path(tube_of(7)) == usual);
  CHECK(path({7, 9, walls, walls}) == usual);
  CHECK(path({9, 2.5, periodic, walls}) == Approx(usual / 4));
  CHECK(path({1.25, 9, walls, periodic}) == Approx(usual / 16));
  CHECK(path({9, 3.5, walls, walls}) == Approx(usual / 4));
  CHECK(path({1.75, 9, walls, walls}) == Approx(usual / 16));
  CHECK(path(tube_of(1.75)) == Approx(usual / 16));
  Accuracy closer = closer_where_narrow(*preset("accurate"), tube_of(2));
  closer.path_tolerance = usual;
  CHECK(closer == *preset("accurate"));
}

TEST_CASE(
    "a creep may stray as far in all, however many steps it takes and however long they are") {
  for (const Stages stages :
       {stages_of<Sphere>(Protocol::heavy_ball), stages_of<Polyhedron>(Protocol::heavy_ball)}) {
    const StageRule& creep = stage_called("creep", stages);
    const auto strays = [&](const Accuracy& accuracy) {
      const StepSettings settings = settings_of(accuracy, creep);
      const auto steps = static_cast<double>(steps_of(accuracy, creep) - creep.steps);
      return steps * settings.limits.rms_tolerance * settings.dt * settings.dt;
    };
    const double usual = strays(Accuracy{});
    CHECK(usual > 0.0);
    for (const int steps : {100, 480, 1600}) {
      for (const double dt : {0.05, 0.1, 0.2}) {
        Accuracy accuracy;
        accuracy.creep_steps = steps;
        accuracy.step = dt;
        // Shares of steps are rounded down: by less than one of the 19 that are fewest here.
        CHECK(strays(accuracy) == Approx(usual).epsilon(1.0 / 19.0));
      }
    }
    // What polyhedra creep at least strays no further than a whole creep does.
    for (const int few : {0, 1, 10}) {
      Accuracy accuracy;
      accuracy.creep_steps = few;
      const StepSettings settings = settings_of(accuracy, creep);
      CHECK(settings.limits.rms_tolerance > 0.0);
      CHECK(static_cast<double>(creep.steps) * settings.limits.rms_tolerance * settings.dt *
                settings.dt <=
            1.06 * usual);  // likewise
    }
  }
}

TEST_CASE("both protocols differ in the fall only") {
  const auto compare = [](Stages damped, Stages plain) {
    REQUIRE(damped.size() == plain.size());
    for (std::size_t k = 0; k < damped.size(); ++k) {
      const bool is_fall = damped[k].name == std::string("fall");
      CHECK(std::string(damped[k].name) == plain[k].name);
      CHECK((damped[k].end == plain[k].end) == !is_fall);
    }
  };
  compare(stages_of<Sphere>(Protocol::heavy_ball), stages_of<Sphere>(Protocol::dynamic));
  compare(stages_of<Polyhedron>(Protocol::heavy_ball), stages_of<Polyhedron>(Protocol::dynamic));
}

TEST_CASE("a bed sleeps in its fall only") {
  for (const Stages stages : all_stages()) {
    for (const StageRule& stage : stages)
      CHECK(stage.sleeps == (stage.name == std::string("fall")));
  }
}

TEST_CASE("plain dynamics is undamped and takes a quarter of a step") {
  Accuracy accuracy;
  accuracy.step = 0.2;
  accuracy.momentum = 0.9;
  CHECK(settings_of(accuracy, dynamic("fall")).momentum == 1.0);
  CHECK(settings_of(accuracy, dynamic("fall")).dt == 0.05);
  CHECK(settings_of(accuracy, heavy_ball("fall")).momentum == 0.9);
  CHECK(settings_of(accuracy, heavy_ball("quench")).momentum == 0.0);
}

}  // namespace
}  // namespace grainsweep
