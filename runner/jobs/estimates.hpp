// What packings will cost together, and how finished packings improve the estimates.
#pragma once

#include <optional>
#include <unordered_map>
#include <vector>

#include "engine/cost.hpp"
#include "engine/scene/spec.hpp"

namespace grainsweep {

/// CPU time of all, s.
double total_cpu_seconds(const std::vector<Cost>& costs);

/// Memory that the `live` largest of the costs take together, bytes.
double bytes_of_largest(const std::vector<Cost>& costs, int live);

/// Bytes that a packing will take on the disk.
struct DiskNeeds {
  double grains = 0.0;  ///< with their forces; none of it with --no-grains
  double curves = 0.0;  ///< with its line in the journal
};

/// Estimate from the sizes of the records that are stored; it knows neither how high the bed will
/// be nor how many contacts it will have, and is right within a fifth or so.
DiskNeeds disk_needs(const PackingSpec& spec);

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
