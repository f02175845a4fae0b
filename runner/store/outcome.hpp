// What is kept of a finished packing.
#pragma once

#include <cstdint>
#include <string>

#include "engine/results.hpp"

namespace grainsweep {

/// Its members are listed, named and explained in runner/store/fields.cpp; the curves are kept with
/// the grains, in states/<job>.grains.
struct Outcome {
  std::string job;       ///< Job::id
  PackingResult result;  ///< without curves, unless they were read
  std::string version;   ///< of the program that made it
  /// The packing ended in an exception (no memory, say), not in a result: it is tried again by the
  /// next run.
  bool exception = false;
  /// Size of states/<job>.grains; 0 if there is no such file, and then there are no curves.
  std::int64_t stored_bytes = 0;
  double cpu_seconds = 0.0;  ///< of all threads that made it
};

}  // namespace grainsweep
