// What is kept of a finished packing, and its form as JSON, without its curves: those are in
// states/<job>.grains, see runner/store/states.hpp.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

#include "engine/results.hpp"

namespace grainsweep {

struct Outcome {
  std::string job;       ///< Job::id
  PackingResult result;  ///< without curves, unless they were read
  std::string version;   ///< of the program that made it
  /// The packing ended in an exception (no memory, say), not in a result: it is tried again by the
  /// next run.
  bool threw = false;
  /// Grains in states/<job>.grains; 0 if there is no such file, and then there are no curves.
  std::int64_t stored_grains = 0;
  double cpu_seconds = 0.0;  ///< of the thread that made it
};

/// All but the curves. Every double reads back with the same bits; not-a-number and infinities are
/// strings.
nlohmann::json to_json(const Outcome& outcome);

/// The opposite of name_of. Throws std::invalid_argument.
PackingStatus status_from(std::string_view name);

/// Throws nlohmann::json::exception or std::invalid_argument if `json` is no outcome.
Outcome outcome_from_json(const nlohmann::json& json);

}  // namespace grainsweep
