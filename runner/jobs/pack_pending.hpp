// The middle of a run: the missing packings of a sweep are made and stored.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "kernels/isa.hpp"
#include "runner/jobs/estimates.hpp"
#include "runner/jobs/known_beds.hpp"
#include "runner/jobs/progress.hpp"
#include "runner/jobs/schedule.hpp"
#include "runner/jobs/time_limit.hpp"
#include "runner/store/claims.hpp"
#include "runner/store/shard_files.hpp"
#include "runner/sweep/job.hpp"
#include "runner/tables/packing_names.hpp"

namespace grainsweep {

/// A run under way.
struct RunningSweep {
  std::string folder;
  ShardFiles& files;
  std::size_t done = 0;  ///< packings of its shard that were made before
  std::vector<const Job*> pending;
  LearnedEstimates estimates = {};    ///< learned from the packings that were made before
  std::optional<Claims> claims = {};  ///< where runners help each other
  KnownBeds beds = {};                ///< of pending packings: measured again, not packed
};

struct PackOptions {
  Limits limits;
  Isa isa{};
  ProgressStyle style = ProgressStyle::quiet;
  double checkpoint_seconds = 60.0;  ///< wall time between two checkpoints of a packing
  bool fail_fast = false;            ///< the first packing that fails stops the others
  TimeLimit time_limit;
  bool no_grains = false;  ///< store only the curves of a bed
  PackingNames names = {};
};

/// What came of it.
struct Packed {
  int packings = 0;           ///< finished now
  int left_to_others = 0;     ///< taken over by other runners
  std::string first_failure;  ///< with fail_fast: the line of the packing that failed
};

/// Makes the pending packings until a signal, a failure or the time limit stops it. Each is on the
/// disk when it counts as finished, and its grains are then no longer in memory. A long one is
/// saved from time to time and when it is stopped, and goes on from there. Throws FileError.
Packed pack_pending(RunningSweep& running, const PackOptions& options);

}  // namespace grainsweep
