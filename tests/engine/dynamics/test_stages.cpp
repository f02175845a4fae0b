#include <catch2/catch.hpp>

#include "engine/dynamics/presets.hpp"
#include "engine/dynamics/stages.hpp"

namespace grainsweep {
namespace {

constexpr Stage heavy_ball[] = {Stage::look,  Stage::fall, Stage::loose_creep,
                                Stage::creep, Stage::halt, Stage::quench};

TEST_CASE("the share done never falls from stage to stage and stays below 1") {
  for (const Preset& known : presets()) {
    double before = 0;
    for (const Stage stage : heavy_ball) {
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

TEST_CASE("the two parts of the creep make up its steps") {
  for (const int steps : {0, 1, 2, 3, 80, 301}) {
    Accuracy accuracy;
    accuracy.creep_steps = steps;
    CHECK(steps_of(accuracy, Stage::loose_creep) + steps_of(accuracy, Stage::creep) == steps);
  }
}

TEST_CASE("the creep is solved better towards its end") {
  Accuracy accuracy;
  accuracy.rest_iterations = 300;
  accuracy.fall_iterations = 77;
  CHECK(settings_of(accuracy, Stage::loose_creep).limits.iterations == 150);
  CHECK(settings_of(accuracy, Stage::creep).limits.iterations == 300);
  CHECK(settings_of(accuracy, Stage::quench).limits.iterations == 600);
  CHECK(settings_of(accuracy, Stage::fall).limits.iterations == 77);
  CHECK(settings_of(accuracy, Stage::dynamic_fall).limits.iterations == 77);
}

TEST_CASE("plain dynamics is undamped and takes a quarter of a step") {
  Accuracy accuracy;
  accuracy.step = 0.2;
  accuracy.momentum = 0.9;
  CHECK(settings_of(accuracy, Stage::dynamic_fall).momentum == 1.0);
  CHECK(settings_of(accuracy, Stage::dynamic_fall).dt == 0.05);
  CHECK(settings_of(accuracy, Stage::fall).momentum == 0.9);
  CHECK(settings_of(accuracy, Stage::quench).momentum == 0.0);
}

}  // namespace
}  // namespace grainsweep
