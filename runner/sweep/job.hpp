// A sweep as the runner works on it: the jobs that a sweep file stands for.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "engine/scene/spec.hpp"
#include "runner/sweep/units.hpp"

namespace grainsweep {

/// Largest error of the means of a group that is asked for: half of the 95 % interval, with the
/// bound of the bias of settling where one was measured. 0: none is asked for.
struct ErrorWish {
  double solid_fraction = 0.0;
  double coordination = 0.0;

  bool is_given() const { return solid_fraction > 0.0 || coordination > 0.0; }
};

/// One packing to make.
struct Job {
  std::string id;          ///< 16 hex digits: hash of `parameters`, master seed and replicate
  std::string label;       ///< of the sweep block it comes from; not part of its identity
  std::string parameters;  ///< resolved parameters as canonical JSON (sorted keys), no replicate
  int replicate = 1;       ///< 1 .. replicates
  std::uint64_t seed = 0;  ///< master seed it was made with
  PackingSpec spec;        ///< random_key: of scene, master seed and replicate
  /// Files it was read from, as written, by the parameter that each gave: "fill.file".
  std::map<std::string, std::string> files = {};
  ErrorWish wish = {};  ///< of its group, which grows until it is met; not part of its identity
};

struct Sweep {
  std::string name;
  std::uint64_t seed = 0;
  int replicates = 1;
  std::vector<Job> jobs;  ///< in the order of the file: block, point, replicate; no id twice
  GivenUnits units = {};  ///< what people want lengths in; no part of any job
};

}  // namespace grainsweep
