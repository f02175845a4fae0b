#include "runner/jobs/thread_team.hpp"

#include <cmath>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include "runner/machine.hpp"

namespace grainsweep {

ThreadTeam::ThreadTeam() : started_at_(thread_cpu_seconds()), owner_(std::this_thread::get_id()) {}

ParallelFor ThreadTeam::loop() {
  return [this](std::size_t parts, const Part& part) { run(parts, part); };
}

double ThreadTeam::cpu_seconds() const {
  return thread_cpu_seconds() - started_at_ + static_cast<double>(helped_.load()) * 1e-9;
}

/// Isolated: a thread that waits for the others must not begin another packing meanwhile. Parts are
/// few and of one size, and are divided simply: a static partitioner mails its tasks to threads,
/// and the mail of a thread that has a packing of its own piles up, some 200 bytes for every loop.
void ThreadTeam::run(std::size_t parts, const Part& part) {
  tbb::task_group_context whole(tbb::task_group_context::isolated);
  loops_.fetch_add(1, std::memory_order_release);
  tbb::this_task_arena::isolate([&] {
    // What a task carries goes from thread to thread inside oneTBB, unseen by the thread sanitizer.
    tbb::parallel_for(
        std::size_t{0}, parts,
        [&](std::size_t number) __attribute__((no_sanitize("thread"))) { run_part(part, number); },
        tbb::simple_partitioner(), whole);
  });
  parts_done_.load(std::memory_order_acquire);
}

void ThreadTeam::run_part(const Part& part, std::size_t number) {
  loops_.load(std::memory_order_acquire);
  const bool is_own = std::this_thread::get_id() == owner_;
  const double start = is_own ? 0.0 : thread_cpu_seconds();
  part(number);
  if (!is_own) helped_ += std::llround((thread_cpu_seconds() - start) * 1e9);
  parts_done_.fetch_add(1, std::memory_order_release);
}

}  // namespace grainsweep
