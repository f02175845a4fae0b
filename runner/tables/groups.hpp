// groups.csv: mean and scatter over the replicates of each parameter set.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "runner/tables/job_facts.hpp"
#include "runner/tables/shape_columns.hpp"

namespace grainsweep {

/// Mean and sample standard deviation (divisor n - 1); NaN where there are too few values.
struct Spread {
  double mean = 0.0;
  double sd = 0.0;
  int n = 0;
};

Spread spread_of(const std::vector<double>& values);

/// Standard error of the mean, sd / sqrt(n); NaN below two values.
double standard_error(const Spread& spread);

/// The packings with one label and one parameter set. Only settled ones enter the means.
struct Group {
  JobFacts job;  ///< the first of them: its replicate number, id and seed mean nothing here
  Spread solid_fraction;
  Spread coordination;             ///< at the first gap tolerance, walls not counted
  Spread coordination_with_walls;  ///< the same, walls counted
  Spread contact_ratio;            ///< contacts over isostatic contacts
  Spread overlap_mean;             ///< d
  /// In the order of shape_columns; without values for spheres.
  std::array<Spread, shape_columns.size()> shape_order;
  std::vector<PackingResult> settled;  ///< in the order of the rows, with curves as far as they had
  std::vector<std::string> jobs;       ///< ids of those
  StatusCounts counts;
};

/// In the order in which the groups first appear.
std::vector<Group> groups_of(const std::vector<Row>& rows);

/// The whole file.
std::string groups_csv(const std::vector<Group>& groups);

}  // namespace grainsweep
