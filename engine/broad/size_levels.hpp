// Grains of similar size, which are searched for together.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/broad/balls.hpp"
#include "engine/broad/grid.hpp"

namespace grainsweep {

/// Grains of similar size and their search grid: radii from the largest down to half of it.
struct SizeLevel {
  double largest_radius = 0.0;  ///< d
  double less = 0.0;            ///< pairs of each of its grains are listed so much less far, d
  std::vector<std::int32_t> members;  ///< ascending
  Cells cells;
  GridColumns grid;
};

/// Largest radius below `below`, d; 0 if there is none.
double largest_radius(const Balls& balls, double below);

/// Sorts the members into levels. A level holds radii from its largest down to half of that, so
/// that a bed of one size has one level; the eighth one holds all that is left. Pairs may be listed
/// by `margin` further than they have to be, half of it for each grain: this holds for grains of at
/// least a quarter of the largest size. For smaller grains it shrinks in proportion to their size.
void choose_levels(const Balls& balls, const std::vector<std::int32_t>& members, double margin,
                   std::vector<SizeLevel>& levels);

/// The level of grains of that radius.
std::size_t level_of(double radius, const std::vector<SizeLevel>& levels);

}  // namespace grainsweep
