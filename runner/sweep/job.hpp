// A sweep as the runner works on it: the jobs that a sweep file stands for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "engine/scene/spec.hpp"
#include "runner/sweep/error_wish.hpp"
#include "runner/sweep/shared_text.hpp"
#include "runner/sweep/units.hpp"

namespace grainsweep {

/// One packing to make.
struct Job {
  std::string id;          ///< 16 hex digits: hash of `parameters`, master seed and replicate
  std::string label;       ///< of the sweep block it comes from; not part of its identity
  SharedText parameters;   ///< resolved parameters as canonical JSON (sorted keys), no replicate
  int replicate = 1;       ///< 1 .. replicates
  std::uint64_t seed = 0;  ///< master seed it was made with
  PackingSpec spec;        ///< random_key: of scene, master seed and replicate
  /// The same as `id` without what is measured: jobs that have it in common end as one bed.
  std::uint64_t bed = 0;
  /// The same without accuracy.max_steps, on which no bed that settles depends: jobs that have it
  /// in common settle as one bed if they have the steps for it.
  std::uint64_t settled_bed = 0;
  /// Files it was read from, as written, by the parameter that each gave: "fill.file".
  std::map<std::string, std::string> files = {};
  /// Requested of its group, which grows until half of the 95 % interval of its means, including
  /// the bound of the bias of settling where one was measured, is no larger; not part of its
  /// identity.
  ErrorWish wish = {};
  /// Requested of its family: the groups between walls grow until half of the 95 % intervals are no
  /// larger, that of a bulk value including the same bound. Not together with `wish`.
  FitWish fit_wish = {};
  ErrorWish asked_accuracy = {};  ///< what chose the preset it settles as; none if a name did
  std::size_t block = 0;          ///< number of the sweep's block that it comes from
};

struct Sweep {
  std::string name;
  std::uint64_t seed = 0;
  int replicates = 1;
  std::vector<Job> jobs;  ///< in the order of the file: block, point, replicate; no id twice
  GivenUnits units = {};  ///< what people want lengths in; no part of any job
  std::vector<std::string> block_pointers = {};  ///< where each block is written
  std::vector<std::string> wish_pointers = {};   ///< where its requested accuracies are
};

}  // namespace grainsweep
