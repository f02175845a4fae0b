// Things that are joined, two by two, into clusters.
#pragma once

#include <cstddef>
#include <numeric>
#include <vector>

namespace grainsweep {

/// The numbers from 0 on, at first each in a cluster of its own (union-find, halving paths).
class Clusters {
 public:
  explicit Clusters(std::size_t things) : parent_(things) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  /// The root of the cluster that i is in: the same for all its members.
  std::size_t root(std::size_t i) {
    while (parent_[i] != i) {
      parent_[i] = parent_[parent_[i]];
      i = parent_[i];
    }
    return i;
  }
  /// Joins the cluster of a to that of b, whose root becomes the root of both.
  void join(std::size_t a, std::size_t b) { parent_[root(a)] = root(b); }

 private:
  std::vector<std::size_t> parent_;
};

}  // namespace grainsweep
