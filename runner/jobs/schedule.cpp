#include "runner/jobs/schedule.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <functional>
#include <mutex>
#include <new>
#include <numeric>
#include <queue>

#include <tbb/global_control.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

namespace grainsweep {
namespace {

Packing failed_packing(const std::string& reason) {
  Packing packing;
  packing.result.status = PackingStatus::failed;
  packing.result.reason = reason;
  return packing;
}

/// Packs one bed; an exception becomes a failed packing.
Finished pack_one(std::size_t index, const Pack& pack, const KeepGoing& go_on) {
  ThreadTeam team;
  Finished finished;
  finished.task = index;
  try {
    finished.packing = pack(index, team, go_on);
  } catch (const std::bad_alloc&) {
    finished.packing = failed_packing("out of memory; use fewer --threads or a smaller bed");
    finished.threw = finished.lacked_memory = true;
  } catch (const std::exception& error) {
    finished.packing = failed_packing(error.what());
    finished.threw = true;
  }
  finished.cpu_seconds = team.cpu_seconds();
  return finished;
}

/// The tasks under way: what the pipeline's two stages share.
class Run {
 public:
  Run(const std::vector<Cost>& costs, const Pack& pack, const TaskEvents& events)
      : pack_(pack), events_(events), order_(longest_first(costs)) {
    visits_.fetch_add(1);
  }

  /// The next task, or stops the pipeline. Called by one thread at a time.
  std::size_t take_next(tbb::flow_control& control) {
    visits_.load();
    std::size_t place = order_.size();
    if (!must_stop()) place = next_.fetch_add(1);  // may_start() may claim a task for this runner
    while (place < order_.size() && !events_.may_start(order_[place])) place = next_.fetch_add(1);
    const bool goes_on = place < order_.size();
    const std::size_t index = goes_on ? order_[place] : 0;
    if (!goes_on) control.stop();
    visits_.fetch_add(1);
    return index;
  }

  void run(std::size_t index) {
    visits_.load();
    if (!must_stop()) make(index);
    visits_.fetch_add(1);
  }

  void join() { visits_.load(); }

 private:
  void make(std::size_t index) {
    events_.started(index);
    const KeepGoing go_on = [&](const Progress& progress) {
      events_.progressed(index, progress);
      return !must_stop();
    };
    Finished finished = pack_one(index, pack_, go_on);
    if (finished.packing.result.status != PackingStatus::cancelled) report(std::move(finished));
  }

  bool must_stop() const { return broken_ || events_.stop_asked(); }

  void report(Finished&& finished) {
    const std::scoped_lock lock(reporting_);
    if (broken_) return;  // what could not be stored may have left half a line
    try {
      events_.finished(std::move(finished));
    } catch (...) {
      broken_ = true;
      throw;
    }
  }

  const Pack& pack_;
  const TaskEvents& events_;
  const std::vector<std::size_t> order_;
  std::atomic<std::size_t> next_{0};
  /// Visits of threads that have ended. Counting orders whatever came before it, also the making of
  /// this object, before every visit and join() that begins later. oneTBB does so too, but inside a
  /// library that the thread sanitizer cannot see into: it would take every task and result for a
  /// race.
  std::atomic<std::size_t> visits_{0};
  std::mutex reporting_;
  std::atomic<bool> broken_{false};
};

}  // namespace

void run_tasks(const std::vector<Cost>& costs, const Limits& limits, const Pack& pack,
               const TaskEvents& events) {
  Run run(costs, pack, events);
  const int live = live_limit(costs, limits);
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(limits.threads));
  tbb::task_arena arena(limits.threads);
  // What a stage carries goes from thread to thread inside oneTBB, unseen by the thread sanitizer.
  const auto take_next = [&](tbb::flow_control & control) __attribute__((no_sanitize("thread"))) {
    return run.take_next(control);
  };
  const auto make = [&](std::size_t index) __attribute__((no_sanitize("thread"))) {
    run.run(index);
  };
  arena.execute([&] {
    tbb::parallel_pipeline(
        static_cast<std::size_t>(live),
        tbb::make_filter<void, std::size_t>(tbb::filter_mode::serial_in_order, take_next) &
            tbb::make_filter<std::size_t, void>(tbb::filter_mode::parallel, make));
  });
  run.join();
}

std::vector<std::size_t> longest_first(const std::vector<Cost>& costs) {
  std::vector<std::size_t> order(costs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return costs[a].cpu_seconds > costs[b].cpu_seconds;
  });
  return order;
}

int live_limit(const std::vector<Cost>& costs, const Limits& limits) {
  std::vector<double> bytes;
  bytes.reserve(costs.size());
  for (const Cost& cost : costs) bytes.push_back(cost.bytes);
  std::sort(bytes.begin(), bytes.end(), std::greater<>());
  int live = 0;
  double sum = 0.0;
  for (const double size : bytes) {
    sum += size;
    if (live == limits.threads || sum > limits.memory) break;
    ++live;
  }
  return std::max(1, live);
}

std::string memory_warning(const std::vector<Cost>& costs, double memory) {
  double largest = 0.0;
  for (const Cost& cost : costs) largest = std::max(largest, cost.bytes);
  if (largest <= memory) return "";
  const auto megabytes = [](double bytes) { return std::to_string(std::llround(bytes / 1e6)); };
  return "warning: the largest packing needs about " + megabytes(largest) + " MB, and " +
         megabytes(memory) + " MB can be had here; end other programs or make the bed smaller\n";
}

double estimate_wall(const std::vector<Cost>& costs, int live) {
  std::priority_queue<double, std::vector<double>, std::greater<>> free_at;
  for (int slot = 0; slot < std::max(1, live); ++slot) free_at.push(0.0);
  double end = 0.0;
  for (const std::size_t index : longest_first(costs)) {
    const double done = free_at.top() + costs[index].cpu_seconds;
    free_at.pop();
    free_at.push(done);
    end = std::max(end, done);
  }
  return end;
}

}  // namespace grainsweep
