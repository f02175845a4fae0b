#include <atomic>
#include <stdexcept>
#include <vector>

#include <catch2/catch.hpp>
#include <tbb/task_arena.h>

#include "runner/crew.hpp"
#include "runner/machine.hpp"

namespace grainsweep {
namespace {

/// Keeps the thread busy for `seconds` of CPU time.
void work_for(double seconds) {
  const double end = thread_cpu_seconds() + seconds;
  while (thread_cpu_seconds() < end) {
  }
}

TEST_CASE("a crew runs each part once, with any number of threads") {
  for (const int threads : {1, 2, 8}) {
    tbb::task_arena arena(threads);
    arena.execute([] {
      Crew crew;
      std::vector<std::atomic<int>> times(1000);
      crew.loop()(times.size(), [&](std::size_t part) { ++times[part]; });
      for (const auto& count : times) CHECK(count == 1);
    });
  }
}

// Whoever runs the parts, their CPU time is the packing's: 40 parts of 5 ms.
TEST_CASE("a crew counts the CPU time of all its threads") {
  tbb::task_arena arena(2);
  arena.execute([] {
    Crew crew;
    crew.loop()(40, [](std::size_t) { work_for(0.005); });
    CHECK(crew.cpu_seconds() >= 0.2);
    CHECK(crew.cpu_seconds() < 0.4);
  });
}

TEST_CASE("what a part throws reaches the packing's own thread") {
  tbb::task_arena arena(2);
  arena.execute([] {
    Crew crew;
    CHECK_THROWS_AS(crew.loop()(100,
                                [](std::size_t part) {
                                  if (part == 57) throw std::runtime_error("no room");
                                }),
                    std::runtime_error);
  });
}

}  // namespace
}  // namespace grainsweep
