// Values of a sweep that no packing depends on.
#pragma once

#include <map>
#include <string>
#include <unordered_map>
#include <vector>

#include "engine/scene/spec.hpp"
#include "runner/sweep/assignments.hpp"
#include "runner/sweep/diagnostic.hpp"
#include "runner/sweep/sweep_definition.hpp"

namespace grainsweep {

class UnusedValues {
 public:
  /// The diagnostics must outlive it.
  explicit UnusedValues(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  /// Remembers what the values in effect at one point of a block are good for.
  void note_use(const Block& block, const InEffect& in_effect, const PackingSpec& spec);

  /// Once all points are through: says which values of the sweep no packing depends on, and which
  /// choices that no point has drawn are out of range.
  void tell(const SweepDefinition& definition);

 private:
  /// Says which of `assignments`, those of "base" or of `block`, no packing depends on. Of "base"
  /// they may be overridden by the blocks `overriding`; of a block that is an error, as is a value
  /// that could never be right.
  void tell(const Assignments& assignments, const std::vector<Block>& overriding,
            const Block* block);
  void note_idle(const std::string& pointer, const std::string& reason);
  void note_choices_out_of_range(const RandomPath& path);

  Diagnostics& diagnostics_;
  /// For every value that was in effect: why no packing depended on it so far; "" if one did.
  std::unordered_map<const Assignment*, std::string> idle_;
  std::map<std::string, std::string> idle_drawn_;  ///< by pointer
};

}  // namespace grainsweep
