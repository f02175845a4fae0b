#include <algorithm>
#include <atomic>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include <catch2/catch.hpp>
#include <tbb/task_arena.h>

#include "runner/jobs/crew.hpp"
#include "runner/machine.hpp"

namespace grainsweep {
namespace {

/// Keeps the thread busy for `seconds` of CPU time.
void work_for(double seconds) {
  const double end = thread_cpu_seconds() + seconds;
  while (thread_cpu_seconds() < end) {
  }
}

/// Runs `work(crew)` as a packing is run.
template <class Work>
void with_crew(int threads, const Work& work) {
  tbb::task_arena arena(threads);
  arena.execute([&] {
    tbb::this_task_arena::isolate([&] {
      Crew crew;
      work(crew);
    });
  });
}

TEST_CASE("a crew runs each part once, with any number of threads, loop after loop") {
  for (const int threads : {1, 2, 8}) {
    with_crew(threads, [](Crew& crew) {
      const ParallelFor loop = crew.loop();
      std::vector<std::atomic<int>> times(100);
      for (int round = 1; round <= 500; ++round) {
        loop(times.size(), [&](std::size_t part) { ++times[part]; });
        REQUIRE(std::all_of(times.begin(), times.end(),
                            [&](const std::atomic<int>& count) { return count == round; }));
      }
    });
  }
}

// What one part writes must be seen by whoever comes after the loop, and by the parts of the next.
TEST_CASE("parts of a loop see all that the last loop wrote") {
  with_crew(2, [](Crew& crew) {
    const ParallelFor loop = crew.loop();
    std::vector<std::uint64_t> from(64, 1), to(64, 0);
    for (int round = 0; round < 2000; ++round) {
      loop(from.size(), [&](std::size_t k) { to[k] = from[k] + from[(k + 7) % from.size()]; });
      from.swap(to);
    }
    CHECK(std::all_of(from.begin(), from.end(), [](std::uint64_t x) { return x == 0; }));
  });
}

TEST_CASE("a loop of no parts does nothing") {
  with_crew(2, [](Crew& crew) {
    crew.loop()(0, [](std::size_t) { FAIL("there is no part"); });
    SUCCEED();
  });
}

// Whoever runs the parts, their CPU time is the packing's: 40 parts of 5 ms; helpers wait awake.
TEST_CASE("a crew counts the CPU time of all its threads") {
  with_crew(2, [](Crew& crew) {
    crew.loop()(40, [](std::size_t) { work_for(0.005); });
    crew.dismiss();
    CHECK(crew.cpu_seconds() >= 0.2);
    CHECK(crew.cpu_seconds() < 0.4);
  });
}

TEST_CASE("loops go on when the helpers have been sent away") {
  with_crew(2, [](Crew& crew) {
    crew.dismiss();
    crew.dismiss();
    std::atomic<int> parts{0};
    crew.loop()(10, [&](std::size_t) { ++parts; });
    CHECK(parts == 10);
  });
}

TEST_CASE("what a part throws reaches the packing's own thread, when all parts are done") {
  with_crew(2, [](Crew& crew) {
    std::atomic<int> parts{0};
    const auto part = [&](std::size_t k) {
      ++parts;
      if (k == 57) throw std::runtime_error("no room");
    };
    CHECK_THROWS_AS(crew.loop()(100, part), std::runtime_error);
    CHECK(parts == 100);
    parts = 0;
    crew.loop()(10, part);
    CHECK(parts == 10);
  });
}

}  // namespace
}  // namespace grainsweep
