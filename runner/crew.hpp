// The threads that work on one packing: its own, and those that have none of their own left.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <thread>

#include "engine/processor.hpp"

namespace grainsweep {

/// Formed by the thread that makes a packing, inside the arena of all threads. Idle threads of the
/// arena take parts of the packing's work; while they all have packings, its own thread does all.
class Crew {
 public:
  Crew();
  Crew(const Crew&) = delete;
  Crew& operator=(const Crew&) = delete;

  /// Hands out parts of work; valid while the crew lives.
  PartLoop loop();

  /// CPU time of all its threads since it was formed, s. Asked by its own thread.
  double cpu_seconds() const;

 private:
  void run_part(std::size_t part, const std::function<void(std::size_t)>& work);

  std::thread::id own_;
  double started_at_;
  std::atomic<std::int64_t> helped_{0};  ///< CPU time of other threads, ns
};

}  // namespace grainsweep
