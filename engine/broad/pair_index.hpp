// Finds whether a pair is in a list, in a few steps: it holds the partners of higher number of each
// grain.
#pragma once

#include <cstdint>
#include <vector>

#include "kernels/kernels.hpp"

namespace grainsweep {

class PairIndex {
 public:
  /// Indexes the pairs a < b of so many grains; earlier pairs are forgotten.
  void assign(std::size_t grains, const std::vector<GrainPair>& pairs) {
    last_.assign(grains, none);
    entries_.clear();
    for (const GrainPair pair : pairs) add(pair);
  }
  void add(GrainPair pair) {
    std::int32_t& last = last_[static_cast<std::size_t>(pair.a)];
    entries_.push_back({pair.b, last});
    last = static_cast<std::int32_t>(entries_.size()) - 1;
  }
  bool holds(GrainPair pair) const {
    std::int32_t k = last_[static_cast<std::size_t>(pair.a)];
    while (k != none && at(k).partner != pair.b) k = at(k).before;
    return k != none;
  }

 private:
  static constexpr std::int32_t none = -1;
  struct Entry {
    std::int32_t partner;
    std::int32_t before;  ///< the previous entry of the same grain
  };
  const Entry& at(std::int32_t k) const { return entries_[static_cast<std::size_t>(k)]; }

  std::vector<std::int32_t> last_;  ///< last entry of each grain
  std::vector<Entry> entries_;
};

}  // namespace grainsweep
