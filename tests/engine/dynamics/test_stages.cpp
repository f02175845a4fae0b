#include <catch2/catch.hpp>

#include "engine/dynamics/presets.hpp"
#include "engine/dynamics/stages.hpp"

namespace grainsweep {
namespace {

Stages heavy_ball() { return stages_of_spheres(Protocol::heavy_ball); }

// Numbers of the stages of spheres.
constexpr std::size_t fall = 1, loose_creep = 2, creep = 3, quench = 5;

TEST_CASE("the share done never falls from stage to stage and stays below 1") {
  for (const Preset& known : presets()) {
    for (const Stages stages :
         {heavy_ball(), stages_of_spheres(Protocol::dynamic), stages_of_shapes()}) {
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

TEST_CASE("every bed is looked at first and tested for rest last") {
  for (const Stages stages :
       {heavy_ball(), stages_of_spheres(Protocol::dynamic), stages_of_shapes()}) {
    CHECK(stages.front().end == StageEnd::look);
    CHECK(stages.back().end == StageEnd::rest);
  }
}

TEST_CASE("the two parts of the creep make up its steps") {
  for (const int steps : {0, 1, 2, 3, 80, 301}) {
    Accuracy accuracy;
    accuracy.creep_steps = steps;
    const std::int64_t loose = steps_of(accuracy, heavy_ball()[loose_creep]);
    CHECK(loose == 2 * steps / 3);
    CHECK(loose + steps_of(accuracy, heavy_ball()[creep]) == steps);
  }
}

TEST_CASE("the creep is solved better towards its end") {
  Accuracy accuracy;
  accuracy.rest_iterations = 300;
  accuracy.fall_iterations = 77;
  const auto iterations = [&](const StageRule& stage) {
    return settings_of(accuracy, stage).limits.iterations;
  };
  CHECK(iterations(heavy_ball()[loose_creep]) == 150);
  CHECK(iterations(heavy_ball()[creep]) == 300);
  CHECK(iterations(heavy_ball()[quench]) == 600);
  CHECK(iterations(heavy_ball()[fall]) == 77);
  CHECK(iterations(stages_of_spheres(Protocol::dynamic)[fall]) == 77);
  CHECK(iterations(stages_of_shapes()[fall]) == 51);  // two thirds
}

TEST_CASE("plain dynamics is undamped and takes a quarter of a step") {
  Accuracy accuracy;
  accuracy.step = 0.2;
  accuracy.momentum = 0.9;
  const Stages dynamic = stages_of_spheres(Protocol::dynamic);
  CHECK(settings_of(accuracy, dynamic[fall]).momentum == 1.0);
  CHECK(settings_of(accuracy, dynamic[fall]).dt == 0.05);
  CHECK(settings_of(accuracy, heavy_ball()[fall]).momentum == 0.9);
  CHECK(settings_of(accuracy, heavy_ball()[quench]).momentum == 0.0);
}

}  // namespace
}  // namespace grainsweep
