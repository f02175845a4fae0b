#include "runner/crew.hpp"

#include <cmath>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "runner/machine.hpp"

namespace grainsweep {

Crew::Crew() : own_(std::this_thread::get_id()), started_at_(thread_cpu_seconds()) {}

// Isolated: a thread that waits for the last part must not begin another packing meanwhile.
PartLoop Crew::loop() {
  return [this](std::size_t parts, const std::function<void(std::size_t)>& work) {
    tbb::this_task_arena::isolate([&] {
      tbb::parallel_for(
          tbb::blocked_range<std::size_t>(0, parts, 1),
          [&](const tbb::blocked_range<std::size_t>& range) {
            for (std::size_t part = range.begin(); part != range.end(); ++part) {
              run_part(part, work);
            }
          },
          tbb::simple_partitioner());
    });
  };
}

double Crew::cpu_seconds() const {
  return thread_cpu_seconds() - started_at_ + static_cast<double>(helped_.load()) * 1e-9;
}

void Crew::run_part(std::size_t part, const std::function<void(std::size_t)>& work) {
  if (std::this_thread::get_id() == own_) {
    work(part);
    return;
  }
  const double start = thread_cpu_seconds();
  work(part);
  helped_ += std::llround((thread_cpu_seconds() - start) * 1e9);
}

}  // namespace grainsweep
