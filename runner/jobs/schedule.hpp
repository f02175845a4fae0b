// Many packings on a few threads: one oneTBB arena, one packing per task, the longest first.
// Threads that find no packing left help with the large ones that are under way.
//
// Longest first keeps the threads busy to the end: the short ones fill the gaps. How many packings
// live at once is bounded by the number of threads and by memory. The order of finishing has no
// influence on any result.
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "engine/context.hpp"
#include "engine/cost.hpp"
#include "engine/results.hpp"
#include "runner/jobs/thread_team.hpp"

namespace grainsweep {

struct Limits {
  int threads = 1;
  /// Bytes for all live packings together; infinite if nothing limits them.
  double memory = std::numeric_limits<double>::infinity();
};

/// Makes the packing of a task, by its index, with the team's help. May throw.
using Pack = std::function<Packing(std::size_t task, ThreadTeam& team, const KeepGoing&)>;

/// What came of a task. Cancelled packings do not count as finished.
struct Finished {
  std::size_t task = 0;  ///< index into the costs
  Packing packing;
  bool threw = false;          ///< `pack` threw; the packing's reason says what
  bool lacked_memory = false;  ///< std::bad_alloc
  double cpu_seconds = 0.0;    ///< of all threads that made it
};

/// Called back while tasks run, from whichever thread runs them. `finished` is never called by two
/// threads at once; if it throws, everything stops and the exception leaves `run_tasks`.
struct TaskEvents {
  std::function<void(std::size_t task)> started;
  std::function<void(std::size_t task, const Progress&)> progressed;
  std::function<void(Finished&&)> finished;
  std::function<bool()> stop_asked;  ///< asked before each task and after each step of a packing
  std::function<bool(std::size_t task)> may_start;  ///< a task that may not is left out
};

/// Runs the tasks, one of each of the estimated `costs`; returns when all are finished or, after
/// stop_asked, the running ones cancelled. A packing that fails or throws never ends the others.
void run_tasks(const std::vector<Cost>& costs, const Limits& limits, const Pack& pack,
               const TaskEvents& events);

/// Indices of the tasks by descending estimated CPU time; equal ones keep their order.
std::vector<std::size_t> longest_first(const std::vector<Cost>& costs);

/// How many packings may live at once: at most `threads`, and so that even the largest ones
/// together stay within the memory; at least one.
int live_limit(const std::vector<Cost>& costs, const Limits& limits);

/// A line that says that the largest packing alone needs more than the memory, and what to do;
/// empty if none does. It is tried all the same: costs are estimates.
std::string memory_warning(const std::vector<Cost>& costs, double memory);

/// Wall time of the tasks, longest first, on so many live packings, s.
double estimate_wall(const std::vector<Cost>& costs, int live);

}  // namespace grainsweep
