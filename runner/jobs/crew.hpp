// The threads that work on one packing: its own, and those that have none of their own left.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>

#include <tbb/task_group.h>

#include "engine/context.hpp"

namespace grainsweep {

/// Formed by the thread that makes a packing, inside the arena of all threads. Idle threads of the
/// arena take parts of the packing's work; while they all have packings, its own thread does all.
///
/// A large bed has a few thousand loops of half a millisecond each in a second. A helper therefore
/// does not leave after a loop: it waits some microseconds for the next one, awake.
class Crew {
 public:
  Crew();
  ~Crew();
  Crew(const Crew&) = delete;
  Crew(Crew&&) = delete;
  Crew& operator=(const Crew&) = delete;
  Crew& operator=(Crew&&) = delete;

  /// Hands out parts of work; valid while the crew lives.
  ParallelFor loop();

  /// Sends the helpers away; loops go on without them. To be called where waiting for them cannot
  /// begin other work: inside tbb::this_task_arena::isolate, as the crew's whole life should be.
  void dismiss();

  /// CPU time of its own thread since it was formed and of the helpers that have left, s.
  double cpu_seconds() const;

 private:
  void run(std::size_t parts, const std::function<void(std::size_t)>& work);
  void call_helpers();
  void help();
  bool take_part();
  void run_part(std::size_t part);

  double started_at_;
  int most_helpers_;
  bool dismissed_ = false;
  std::atomic<int> helpers_{0};          ///< called and not gone
  std::atomic<std::int64_t> helped_{0};  ///< CPU time of helpers, ns
  std::atomic<bool> over_{false};        ///< no more loops will come

  /// The loop under way. Its parts are claimed by counting up `claims_`: the loop's number in the
  /// upper half, so that a late helper claims nothing of the next one by mistake; the parts that
  /// are left in the lower half. `work_` stays what it is while a claimed part is not done.
  std::atomic<std::uint64_t> claims_{0};
  std::atomic<std::size_t> done_{0};
  const std::function<void(std::size_t)>* work_ = nullptr;
  std::mutex failing_;
  std::exception_ptr failure_;  ///< the first one

  tbb::task_group group_;
};

}  // namespace grainsweep
