#include "runner/jobs/crew.hpp"

#include <cmath>
#include <thread>
#include <utility>

#include <tbb/task_arena.h>

#include "runner/machine.hpp"

namespace grainsweep {

namespace {

constexpr std::uint64_t parts_mask = 0xFFFFFFFF;

/// Waits a moment: soon awake again at first, then letting other threads have the core.
void pause(int times_before) {
  constexpr int awake = 4000;  // about 100 microseconds
  if (times_before < awake) {
    __builtin_ia32_pause();
  } else {
    std::this_thread::yield();
  }
}

}  // namespace

Crew::Crew()
    : started_at_(thread_cpu_seconds()),
      most_helpers_(tbb::this_task_arena::max_concurrency() - 1) {}

Crew::~Crew() { dismiss(); }

ParallelFor Crew::loop() {
  return
      [this](std::size_t parts, const std::function<void(std::size_t)>& work) { run(parts, work); };
}

void Crew::dismiss() {
  if (!dismissed_) {
    dismissed_ = true;
    over_.store(true);
    group_.wait();
  }
}

double Crew::cpu_seconds() const {
  return thread_cpu_seconds() - started_at_ + static_cast<double>(helped_.load()) * 1e-9;
}

void Crew::run(std::size_t parts, const std::function<void(std::size_t)>& work) {
  if (parts == 0) return;
  work_ = &work;
  done_.store(0, std::memory_order_relaxed);
  const std::uint64_t number = (claims_.load(std::memory_order_relaxed) >> 32U) + 1;
  claims_.store((number << 32U) | parts, std::memory_order_release);
  call_helpers();
  while (take_part()) {
  }
  for (int waited = 0; done_.load(std::memory_order_acquire) != parts; ++waited) pause(waited);
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
}

void Crew::call_helpers() {
  while (!dismissed_ && helpers_.load(std::memory_order_relaxed) < most_helpers_) {
    helpers_.fetch_add(1, std::memory_order_relaxed);
    // What a task carries goes from thread to thread inside oneTBB, unseen by the thread sanitizer.
    group_.run([this]() __attribute__((no_sanitize("thread"))) { help(); });
  }
}

void Crew::help() {
  constexpr int most_pauses = 8000;
  const double start = thread_cpu_seconds();
  // Parts first: claiming one is what makes the crew's other members known to this thread.
  for (int waited = 0; waited < most_pauses; ++waited) {
    if (take_part()) {
      waited = 0;
    } else if (over_.load(std::memory_order_relaxed)) {
      break;
    } else {
      pause(0);
    }
  }
  helped_ += std::llround((thread_cpu_seconds() - start) * 1e9);
  helpers_.fetch_sub(1, std::memory_order_relaxed);
}

/// Claims a part of the loop under way and runs it; false if none is left. A claim sees what was
/// written before the loop, and nothing of what other parts write: the thread sanitizer would miss
/// parts that are in each other's way.
bool Crew::take_part() {
  std::uint64_t claims = claims_.load(std::memory_order_acquire);
  while ((claims & parts_mask) != 0) {
    if (claims_.compare_exchange_weak(claims, claims - 1, std::memory_order_acquire)) {
      run_part((claims & parts_mask) - 1);
      return true;
    }
  }
  return false;
}

void Crew::run_part(std::size_t part) {
  try {
    (*work_)(part);
  } catch (...) {
    const std::scoped_lock lock(failing_);
    if (!failure_) failure_ = std::current_exception();
  }
  done_.fetch_add(1, std::memory_order_release);
}

}  // namespace grainsweep
