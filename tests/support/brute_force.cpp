#include "tests/support/brute_force.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <catch2/catch.hpp>

namespace grainsweep::testing {

namespace {

/// Smallest difference over the images; a period of 0 has none.
double image_difference(double difference, double period) {
  double least = std::numeric_limits<double>::max();
  for (int image = period > 0.0 ? -3 : 0; image <= (period > 0.0 ? 3 : 0); ++image) {
    least = std::min(least, std::abs(difference + image * period));
  }
  return least;
}

/// Needs no image: more than three quarters of all pairs in a bed that is higher than wide.
bool is_far_above(const SphereBed& bed, std::int32_t a, std::int32_t b, double reach) {
  const Record<double>& p = bed.position[static_cast<std::size_t>(a)];
  const Record<double>& q = bed.position[static_cast<std::size_t>(b)];
  return p.z - q.z > p.w + q.w + reach + 1e-9;  // far beyond rounding
}

}  // namespace

double gap_of(const SphereBed& bed, std::int32_t a, std::int32_t b) {
  const Record<double>& p = bed.position[static_cast<std::size_t>(a)];
  const Record<double>& q = bed.position[static_cast<std::size_t>(b)];
  const double x = image_difference(p.x - q.x, bed.box.period_x());
  const double y = image_difference(p.y - q.y, bed.box.period_y());
  return std::hypot(x, y, p.z - q.z) - p.w - q.w;
}

std::set<NamedPair> pairs_closer_than(const SphereBed& bed, double reach) {
  std::set<NamedPair> pairs;
  for (std::int32_t a = 0; a < bed.wall(); ++a) {
    for (std::int32_t b = a + 1; b < bed.wall(); ++b) {
      if (is_far_above(bed, a, b, reach) || is_far_above(bed, b, a, reach)) continue;
      if (gap_of(bed, a, b) < reach) pairs.insert({a, b});
    }
  }
  return pairs;
}

std::set<NamedPair> listed_pairs(const Candidates& candidates) {
  std::set<NamedPair> pairs;
  bool ordered = true;
  for (const GrainPair& pair : candidates.pairs) {
    ordered = ordered && pair.a < pair.b;
    pairs.insert({pair.a, pair.b});
  }
  REQUIRE(ordered);
  REQUIRE(pairs.size() == candidates.pairs.size());  // none twice
  return pairs;
}

bool holds_all_closer_than(const SphereBed& bed, const Candidates& candidates, double reach) {
  const auto listed = listed_pairs(candidates), close = pairs_closer_than(bed, reach);
  bool holds = std::includes(listed.begin(), listed.end(), close.begin(), close.end());
  for (std::size_t k = 0; k < candidates.walls.size(); ++k) {
    const std::set<std::int32_t> listed_at(candidates.walls[k].begin(), candidates.walls[k].end());
    for (std::int32_t i = 0; i < bed.wall(); ++i) {
      const bool is_listed = listed_at.contains(i);
      const bool is_close = bed.walls[k].gap(bed.position[static_cast<std::size_t>(i)]) < reach;
      holds = holds && (is_listed || !is_close);
    }
  }
  return holds;
}

}  // namespace grainsweep::testing
