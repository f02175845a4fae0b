// Rows of packings between walls that follow known lines and have known layers.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "tests/runner/sample_rows.hpp"

namespace grainsweep {

/// Adds two packings on the lines 0.64 - c / W and 6 - 3 / W with layers at walls that decay over
/// 7 c d, and fewer neighbours within 1 d of a wall.
inline void add_width(std::vector<Row>& rows, double width, double small_share = 0.0,
                      double c = 0.2) {
  for (const double scatter : {-0.001, 0.001}) {
    const std::string id = std::to_string(rows.size());
    Row row = settled_row(id, width, 0.64 - c / width + scatter, 6 - 3 / width + 10 * scatter,
                          Boundary::walls, small_share);
    row.outcome->result.mean_diameter = 0.5;
    row.outcome->result.mean_diameter_by_volume = 0.8;
    std::mt19937_64 generator(rows.size());
    std::normal_distribution<double> normal(0, 0.001);
    Profile& profile = row.outcome->result.profile_y;
    profile.bin_width = 0.1;
    for (double y = 0.05; y < width; y += 0.1) {
      const double from_wall = std::min(y, width - y);
      const double layers = 0.3 * std::exp(-from_wall / (7 * c)) * std::cos(7 * from_wall);
      const std::int64_t neighbours = from_wall < 1 ? 46 : 60;
      profile.bins.push_back({0.6 + layers + normal(generator), 0, 10, 0, neighbours, 0});
    }
    rows.push_back(row);
  }
}

/// W = 5, 10 and 20, and two packings without walls whose Z is 6.00 +- 0.02.
inline std::vector<Row> wall_sweep() {
  std::vector<Row> rows;
  for (const double width : {5.0, 10.0, 20.0}) add_width(rows, width);
  for (const double z : {5.98, 6.02}) {
    rows.push_back(settled_row("p" + std::to_string(z), 20, 0.64, z, Boundary::periodic));
  }
  return rows;
}

/// The wall sweep and the same with shares of small grains and smaller slopes.
inline std::vector<Row> wall_sweep_of_three_families() {
  std::vector<Row> rows = wall_sweep();
  for (const double share : {0.25, 0.4}) {
    for (const double width : {5.0, 10.0, 20.0}) add_width(rows, width, share, 0.2 - 0.2 * share);
  }
  return rows;
}

}  // namespace grainsweep
