#include "engine/broad/size_levels.hpp"

#include <algorithm>

#include "engine/units.hpp"

namespace grainsweep {

namespace {

/// Levels of sizes told apart; smaller grains share the last one.
constexpr std::size_t max_levels = 8;

void choose_margins(double margin, std::vector<SizeLevel>& levels) {
  constexpr double full_margin = 0.25;  // of the largest size
  for (SizeLevel& level : levels) {
    const double size = level.largest_radius / levels.front().largest_radius;
    level.less = size < full_margin ? 0.5 * margin * (1.0 - size / full_margin) : 0.0;
  }
}

}  // namespace

double largest_radius(const Balls& balls, double below) {
  double largest = 0.0;
  for (std::size_t i = 0; i < balls.bed.grains(); ++i) {
    const double radius = balls.ball[i].w;
    if (radius < below) largest = std::max(largest, radius);
  }
  return largest;
}

std::size_t level_of(double radius, const std::vector<SizeLevel>& levels) {
  std::size_t level = 0;
  while (level + 1 < levels.size() && radius < 0.5 * levels[level].largest_radius) ++level;
  return level;
}

void choose_levels(const Balls& balls, const std::vector<std::int32_t>& members, double margin,
                   std::vector<SizeLevel>& levels) {
  std::size_t count = 0;
  double below = infinity;
  for (double largest = largest_radius(balls, below); count == 0 || largest > 0.0;
       largest = largest_radius(balls, below)) {
    if (levels.size() <= count) levels.emplace_back();
    levels[count].largest_radius = largest;
    levels[count].members.clear();
    below = ++count < max_levels ? std::min(below, 0.5 * largest) : 0.0;
  }
  levels.resize(count);
  for (const std::int32_t grain : members) {
    const double radius = balls.ball[static_cast<std::size_t>(grain)].w;
    levels[level_of(radius, levels)].members.push_back(grain);
  }
  choose_margins(margin, levels);
}

}  // namespace grainsweep
