#include <atomic>
#include <chrono>
#include <mutex>
#include <new>
#include <set>
#include <stdexcept>
#include <thread>

#include <catch2/catch.hpp>

#include "runner/jobs/schedule.hpp"

namespace grainsweep {
namespace {

struct Bench {
  std::vector<Cost> costs;

  explicit Bench(const std::vector<double>& cpu_seconds, double bytes = 0.0) {
    for (const double seconds : cpu_seconds) costs.push_back({seconds, bytes});
  }
};

Packing settled() {
  Packing packing;
  packing.result.status = PackingStatus::settled;
  return packing;
}

/// What `run_tasks` told its caller.
struct Log {
  std::mutex mutex;
  std::vector<std::size_t> started;
  std::vector<Finished> finished;
  std::atomic<bool> stop{false};

  TaskEvents events() {
    TaskEvents events;
    events.started = [this](std::size_t task) {
      const std::scoped_lock lock(mutex);
      started.push_back(task);
    };
    events.progressed = [](std::size_t, const Progress&) {};
    events.finished = [this](Finished&& one) { finished.push_back(std::move(one)); };
    events.stop_asked = [this] { return stop.load(); };
    events.may_start = [](std::size_t) { return true; };
    return events;
  }
};

TEST_CASE("tasks start the longest first, equal ones in their order") {
  const Bench bench({1, 5, 3, 5, 2});
  Log log;
  run_tasks(
      bench.costs, Limits{1}, [](std::size_t, ThreadTeam&, const KeepGoing&) { return settled(); },
      log.events());
  CHECK(log.started == std::vector<std::size_t>{1, 3, 2, 4, 0});
  CHECK(log.finished.size() == 5);
}

TEST_CASE("tasks that may not start are left out, shorter ones behind them are not") {
  const Bench bench({1, 5, 3, 5, 2});
  Log log;
  TaskEvents events = log.events();
  events.may_start = [&](std::size_t task) { return bench.costs[task].cpu_seconds < 3; };
  run_tasks(
      bench.costs, Limits{1}, [](std::size_t, ThreadTeam&, const KeepGoing&) { return settled(); },
      events);
  CHECK(log.started == std::vector<std::size_t>{4, 0});
}

TEST_CASE("every task is finished exactly once on any number of threads") {
  for (const int threads : {1, 2, 8}) {
    const Bench bench(std::vector<double>(200, 1.0));
    Log log;
    run_tasks(
        bench.costs, {threads, 0},
        [](std::size_t, ThreadTeam&, const KeepGoing&) { return settled(); }, log.events());
    std::set<std::size_t> tasks;
    for (const Finished& finished : log.finished) tasks.insert(finished.task);
    CHECK(log.finished.size() == 200);
    CHECK(tasks.size() == 200);
  }
}

/// Most packings alive at once. Each waits until `expected` are, or gives up: long enough for a
/// loaded machine to start them, and what is never reached costs only that time.
int most_alive(int threads, double memory, double bytes, int expected) {
  constexpr auto patience = std::chrono::milliseconds(500);
  const Bench bench(std::vector<double>(24, 1.0), bytes);
  std::atomic<int> alive{0}, most{0};
  Log log;
  const Pack pack = [&](std::size_t, ThreadTeam&, const KeepGoing&) {
    const int now = ++alive;
    for (int seen = most; now > seen && !most.compare_exchange_weak(seen, now);) continue;
    const auto give_up = std::chrono::steady_clock::now() + patience;
    while (most < expected && std::chrono::steady_clock::now() < give_up) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    --alive;
    return settled();
  };
  run_tasks(bench.costs, {threads, memory}, pack, log.events());
  return most;
}

TEST_CASE("as many packings live at once as there are threads, also beyond the cores") {
  const double unlimited = Limits{}.memory;
  CHECK(most_alive(1, unlimited, 0, 1) == 1);
  CHECK(most_alive(3, unlimited, 0, 3) == 3);
  CHECK(most_alive(8, unlimited, 0, 8) == 8);
}

TEST_CASE("memory bounds the packings that live at once") {
  CHECK(most_alive(8, 250, 100, 2) == 2);
  CHECK(most_alive(8, 10, 100, 1) == 1);
}

TEST_CASE("the live limit makes room for the largest packings together") {
  const Bench bench({1, 1, 1, 1});
  std::vector<Cost> costs = bench.costs;
  costs[0].bytes = 10;
  costs[1].bytes = 100;
  costs[2].bytes = 60;
  costs[3].bytes = 5;
  CHECK(live_limit(costs, Limits{4}) == 4);
  CHECK(live_limit(costs, {4, 175}) == 4);
  CHECK(live_limit(costs, {4, 174}) == 3);
  CHECK(live_limit(costs, {4, 160}) == 2);
  CHECK(live_limit(costs, {4, 99}) == 1);
  CHECK(live_limit(costs, {2, 1000}) == 2);
}

TEST_CASE("a packing larger than the memory is announced, one that fits is not") {
  const Bench bench({1, 2}, 3e9);
  CHECK(memory_warning(bench.costs, 3e9).empty());
  CHECK(memory_warning(bench.costs, Limits{}.memory).empty());
  CHECK_THAT(memory_warning(bench.costs, 2e9),
             Catch::Contains("needs about 3000 MB, and 2000 MB can be had"));
}

TEST_CASE("a packing that throws or fails does not end the others") {
  const Bench bench({4, 3, 2, 1});
  Log log;
  const Pack pack = [](std::size_t task, ThreadTeam&, const KeepGoing&) -> Packing {
    if (task == 0) throw std::runtime_error("a broken kernel");
    if (task == 1) throw std::bad_alloc();
    Packing packing = settled();
    if (task == 2) packing.result.status = PackingStatus::failed;
    return packing;
  };
  run_tasks(bench.costs, Limits{1}, pack, log.events());
  REQUIRE(log.finished.size() == 4);
  CHECK(log.finished[0].threw);
  CHECK(log.finished[0].packing.result.status == PackingStatus::failed);
  CHECK(log.finished[0].packing.result.reason == "a broken kernel");
  CHECK_THAT(log.finished[1].packing.result.reason, Catch::StartsWith("out of memory"));
  CHECK_FALSE(log.finished[2].threw);
  CHECK(log.finished[3].packing.result.status == PackingStatus::settled);
}

TEST_CASE("stopping keeps what is finished, cancels what runs and starts nothing more") {
  const Bench bench({3, 2, 1});
  Log log;
  const Pack pack = [&](std::size_t task, ThreadTeam&, const KeepGoing& keep_going) {
    if (task == 0) return settled();
    log.stop = true;
    Packing packing;
    packing.result.status =
        keep_going({1, 0.1}) ? PackingStatus::settled : PackingStatus::cancelled;
    return packing;
  };
  run_tasks(bench.costs, Limits{1}, pack, log.events());
  REQUIRE(log.finished.size() == 1);
  CHECK(log.finished[0].task == 0);
  CHECK(log.started == std::vector<std::size_t>{0, 1});
}

TEST_CASE("an error while storing stops the run and reaches the caller") {
  const Bench bench(std::vector<double>(50, 1.0));
  Log log;
  TaskEvents events = log.events();
  events.finished = [](Finished&&) { throw std::runtime_error("disk full"); };
  const Pack pack = [](std::size_t, ThreadTeam&, const KeepGoing&) { return settled(); };
  CHECK_THROWS_WITH(run_tasks(bench.costs, Limits{2}, pack, events), "disk full");
  CHECK(log.started.size() <= 4);
}

TEST_CASE("CPU time is that of the packing's own thread, not time asleep") {
  const Bench bench({1, 1});
  Log log;
  const Pack pack = [](std::size_t task, ThreadTeam&, const KeepGoing&) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(60);
    if (task == 0) std::this_thread::sleep_until(end);
    volatile int spin = 0;
    while (task == 1 && std::chrono::steady_clock::now() < end) spin = spin + 1;
    return settled();
  };
  run_tasks(bench.costs, Limits{1}, pack, log.events());
  REQUIRE(log.finished.size() == 2);
  CHECK(log.finished[0].cpu_seconds < 0.03);
  CHECK(log.finished[1].cpu_seconds > log.finished[0].cpu_seconds);
}

TEST_CASE("progress of a packing reaches the caller") {
  const Bench bench({1});
  Log log;
  TaskEvents events = log.events();
  std::vector<double> shares;
  events.progressed = [&](std::size_t task, const Progress& progress) {
    CHECK(task == 0);
    shares.push_back(progress.share_done);
  };
  const Pack pack = [](std::size_t, ThreadTeam&, const KeepGoing& keep_going) {
    CHECK(keep_going({1, 0.25}));
    CHECK(keep_going({2, 0.5}));
    return settled();
  };
  run_tasks(bench.costs, Limits{1}, pack, events);
  CHECK(shares == std::vector<double>{0.25, 0.5});
}

TEST_CASE("no tasks end at once") {
  Log log;
  run_tasks(
      {}, Limits{4}, [](std::size_t, ThreadTeam&, const KeepGoing&) { return settled(); },
      log.events());
  CHECK(log.finished.empty());
}

TEST_CASE("the estimated wall time is that of the longest-first order") {
  const Bench bench({2, 5, 4, 3});
  CHECK(estimate_wall(bench.costs, 1) == 14);
  CHECK(estimate_wall(bench.costs, 2) == 7);
  CHECK(estimate_wall(bench.costs, 8) == 5);
  CHECK(estimate_wall({}, 2) == 0);
}

}  // namespace
}  // namespace grainsweep
