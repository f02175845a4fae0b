#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <stdexcept>
#include <thread>
#include <vector>

#include <catch2/catch.hpp>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include "runner/jobs/thread_team.hpp"
#include "runner/machine.hpp"

namespace grainsweep {
namespace {

/// Keeps the thread busy for `seconds` of CPU time.
void work_for(double seconds) {
  const double end = thread_cpu_seconds() + seconds;
  while (thread_cpu_seconds() < end) {
  }
}

/// Runs `work(team)` as a packing is run.
template <class Work>
void with_team(int threads, const Work& work) {
  tbb::task_arena arena(threads);
  arena.execute([&] {
    ThreadTeam team;
    work(team);
  });
}

TEST_CASE("each part runs once, with any number of threads, loop after loop") {
  for (const int threads : {1, 2, 8}) {
    with_team(threads, [](ThreadTeam& team) {
      const ParallelFor loop = team.loop();
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
  with_team(2, [](ThreadTeam& team) {
    const ParallelFor loop = team.loop();
    std::vector<std::uint64_t> from(64, 1), to(64, 0);
    for (std::uint64_t round = 1; round <= 2000; ++round) {
      loop(from.size(),
           [&](std::size_t k) { to[k] = std::min(from[k], from[(k + 7) % from.size()]) + 1; });
      from.swap(to);
      REQUIRE(std::all_of(from.begin(), from.end(), [=](auto x) { return x == round + 1; }));
    }
  });
}

TEST_CASE("a loop of no parts does nothing") {
  with_team(2, [](ThreadTeam& team) {
    team.loop()(0, [](std::size_t) { FAIL("there is no part"); });
    SUCCEED();
  });
}

// oneTBB calls off all that a run has begun once one of its packings cannot be stored.
TEST_CASE("a loop is whole even where the run that it belongs to is called off") {
  tbb::task_group_context run;
  std::atomic<int> parts{0};
  tbb::parallel_for(
      0, 1,
      [&](int) {
        run.cancel_group_execution();
        ThreadTeam team;
        team.loop()(100, [&](std::size_t) { ++parts; });
      },
      run);
  CHECK(parts == 100);
}

// Whoever runs the parts, their CPU time is the packing's: 40 parts of 5 ms.
TEST_CASE("the CPU time of all threads is counted") {
  with_team(2, [](ThreadTeam& team) {
    team.loop()(40, [](std::size_t) { work_for(0.005); });
    CHECK(team.cpu_seconds() >= 0.2);
    CHECK(team.cpu_seconds() < 0.4);
  });
}

// The packings lie with a thread that takes none of them: the other two find there what to do while
// one works for the other's loop.
TEST_CASE("a thread that waits for parts of its loop begins no other packing") {
  const tbb::global_control more_than_cores(tbb::global_control::max_allowed_parallelism, 3);
  tbb::task_arena arena(3);
  constexpr int packings = 100;
  std::atomic<int> done{0}, nested{0};
  const auto pack = [&] {
    static thread_local bool is_busy = false;
    nested += is_busy ? 1 : 0;
    is_busy = true;
    ThreadTeam team;
    // Asleep, so that parts of a loop are under way side by side however busy the machine is.
    team.loop()(4,
                [](std::size_t) { std::this_thread::sleep_for(std::chrono::microseconds(200)); });
    is_busy = false;
    ++done;
  };
  arena.execute([&] {
    tbb::task_group group;
    for (int k = 0; k < packings; ++k) group.run(pack);
    while (done < packings) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    group.wait();
  });
  CHECK(nested == 0);
}

TEST_CASE("what a part throws reaches the packing's own thread, and the next loop is whole") {
  with_team(2, [](ThreadTeam& team) {
    std::atomic<int> parts{0};
    const auto part = [&](std::size_t k) {
      ++parts;
      if (k == 57) throw std::runtime_error("no room");
    };
    CHECK_THROWS_AS(team.loop()(100, part), std::runtime_error);
    parts = 0;
    team.loop()(10, part);
    CHECK(parts == 10);
  });
}

}  // namespace
}  // namespace grainsweep
