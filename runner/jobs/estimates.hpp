// What packings will take together, and what those that are made teach of it.
#pragma once

#include <optional>
#include <unordered_map>
#include <vector>

#include "engine/cost.hpp"

namespace grainsweep {

/// CPU time of all, s.
double total_cpu_seconds(const std::vector<Cost>& costs);

/// What so many of the costs take that live at once, the largest, bytes.
double bytes_of_largest(const std::vector<Cost>& costs, int live);

/// The estimated CPU time of a packing and, if it is made, what it took, s.
struct Known {
  double estimated = 0.0;
  std::optional<double> measured;
};

/// Better estimates: packings that are made teach. What those of the same estimate took in the
/// mean, or else the estimate times the ratio over all that are made.
class LearnedEstimates {
 public:
  /// A packing that was estimated so, and took so long, s.
  void add(double estimated, double measured);
  /// What a packing that is estimated so will take, s.
  double of(double estimated) const;

 private:
  /// What packings that are made took together, and what was estimated.
  struct Sums {
    double measured = 0.0, estimated = 0.0;
    double ratio() const { return estimated > 0.0 ? measured / estimated : 1.0; }
  };
  Sums of_all_;
  std::unordered_map<double, Sums> of_estimate_;
};

/// Those of all, s, as all that are made teach them.
std::vector<double> learned(const std::vector<Known>& packings);

}  // namespace grainsweep
