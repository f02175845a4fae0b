// What packings will cost together, and how finished packings improve the estimates.
#pragma once

#include <optional>
#include <unordered_map>
#include <vector>

#include "engine/cost.hpp"

namespace grainsweep {

/// CPU time of all, s.
double total_cpu_seconds(const std::vector<Cost>& costs);

/// Memory that the `live` largest of the costs take together, bytes.
double bytes_of_largest(const std::vector<Cost>& costs, int live);

/// The estimated CPU time of a packing and, if it is made, what it took, s.
struct Known {
  double estimated = 0.0;
  std::optional<double> measured;
};

/// Better estimates, learned from finished packings: the mean measured time of those with the same
/// estimate, or else the estimate times the ratio of measured to estimated time over all of them.
class LearnedEstimates {
 public:
  /// Adds a finished packing by its estimated and measured CPU time, s.
  void add(double estimated, double measured);
  /// What a packing with this estimate will take, s.
  double of(double estimated) const;

 private:
  /// What finished packings took together, and what was estimated for them.
  struct Sums {
    double measured = 0.0, estimated = 0.0;
    double ratio() const { return estimated > 0.0 ? measured / estimated : 1.0; }
  };
  Sums of_all_;
  std::unordered_map<double, Sums> of_estimate_;
};

/// The better estimate of each packing, s, learned from all that are made.
std::vector<double> learned(const std::vector<Known>& packings);

}  // namespace grainsweep
