// A sweep as the runner works on it: the jobs that a sweep file stands for.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/scene/spec.hpp"

namespace grainsweep {

/// One packing to make.
struct Job {
  std::string id;          ///< 16 hex digits: hash of `parameters`, master seed and replicate
  std::string label;       ///< of the sweep block it comes from; not part of its identity
  std::string parameters;  ///< resolved parameters as canonical JSON (sorted keys), no replicate
  int replicate = 1;       ///< 1 .. replicates
  std::uint64_t seed = 0;  ///< master seed it was made with
  PackingSpec spec;        ///< random_key is derived from id alone
};

struct Sweep {
  std::string name;
  std::uint64_t seed = 0;
  int replicates = 1;
  std::vector<Job> jobs;  ///< in the order of the file: block, point, replicate; no id twice
};

/// One thing wrong with the input: where, what, and what to change.
struct Finding {
  std::string place;    ///< "spheres.json:12:20", or the file alone where there is no line
  std::string pointer;  ///< JSON pointer of the value, "" where there is none
  std::string message;  ///< "must lie in [0, 1], is 1.4"
};

/// "spheres.json:12:20 /base/sizes/small_share: must lie in [0, 1], is 1.4"; control characters
/// become question marks.
std::string to_string(const Finding& finding);

struct SweepReading {
  Sweep sweep;                  ///< meaningful only if `errors` is empty
  std::vector<Finding> errors;  ///< all of them, in the order of the file
};

/// Reads and expands a sweep file. Never throws for bad input: every error is a Finding.
SweepReading read_sweep(const std::string& path);

}  // namespace grainsweep
