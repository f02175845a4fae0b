// The middle of a run: what is missing of a sweep is packed and stored.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "kernels/isa.hpp"
#include "runner/jobs/estimates.hpp"
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
  LearnedEstimates estimates = {};    ///< taught by the packings that were made before
  std::optional<Claims> claims = {};  ///< where runners help each other
};

struct PackOptions {
  Limits limits;
  Isa isa{};
  ProgressStyle style = ProgressStyle::quiet;
  double checkpoint_seconds = 60.0;  ///< wall time between two checkpoints of a packing
  bool fail_fast = false;            ///< the first packing that fails stops the others
  TimeLimit time_limit;
  bool no_grains = false;  ///< of a bed only its curves are stored
  PackingNames names = {};
};

/// What came of it.
struct Packed {
  int packings = 0;           ///< finished now
  int left_to_others = 0;     ///< that other runners have taken over
  std::string first_failure;  ///< with fail_fast: the line of the packing that failed
};

/// Makes the pending packings, as far as no signal, no failure and no end of its time stops it;
/// each is on the disk when it counts as finished, and then its grains no longer in memory. A long
/// one is saved from time to time and when it is stopped, and goes on from there. Throws FileError.
Packed pack_pending(RunningSweep& running, const PackOptions& options);

}  // namespace grainsweep
