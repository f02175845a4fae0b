// What is kept of a finished packing.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "engine/results.hpp"

namespace grainsweep {

/// Its members are listed, named and explained in runner/store/fields.cpp; the curves are kept with
/// the grains, in shards/<shard>.beds.
struct Outcome {
  std::string job;                   ///< Job::id
  PackingResult result;              ///< without curves, unless they were read
  std::string version;               ///< of the program that made it
  std::optional<std::uint64_t> bed;  ///< Job::bed of one whose grains are stored
  /// The packing ended in an exception (no memory, say), not in a result: it is tried again by the
  /// next run.
  bool exception = false;
  double finished_at = 0.0;  ///< s since 1970
  std::string shard;         ///< name of the files that hold it, see runner/store/shard.hpp
  /// Where in shards/<shard>.beds its bed is, and its size; 0 if there is none, and then there are
  /// no curves.
  std::int64_t stored_at = 0, stored_bytes = 0;
  double cpu_seconds = 0.0;  ///< of all threads that made it
};

}  // namespace grainsweep
