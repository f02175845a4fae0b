// The structure of a sweep file: what it says, before it is multiplied out.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "runner/sweep/assignments.hpp"
#include "runner/sweep/diagnostic.hpp"
#include "runner/sweep/job.hpp"
#include "runner/sweep/json_text.hpp"
#include "runner/sweep/random_points.hpp"
#include "runner/sweep/read_replicates.hpp"
#include "runner/sweep/units.hpp"

namespace grainsweep {

/// Most jobs of one sweep; a job takes about 1.5 kB while a sweep runs.
inline constexpr std::uint64_t most_jobs = 1'000'000;

/// One list that a block runs through: a path of its grid, or its whole zip.
struct Axis {
  std::string name;                  ///< "box.width", "zip"
  std::vector<Assignments> entries;  ///< an entry that could not be read is empty
  std::uint64_t left_out = 0;        ///< of a range in a sweep that is too large anyway

  std::uint64_t size() const { return entries.size() + left_out; }
};

/// A block of the sweep: the product of its axes and its random points.
struct Block {
  std::string label;
  std::string pointer;             ///< "/sweep/0", "" for a sweep of `base` alone
  Replicates replicates;           ///< of each point
  Assignments set;                 ///< over `base`, under the axes
  std::vector<Axis> axes;          ///< the first one changes slowest
  std::vector<RandomPath> random;  ///< drawn together
  std::uint64_t random_count = 0;  ///< points to draw; changes fastest
};

struct SweepDefinition {
  std::string name;
  std::uint64_t seed = 0;
  Replicates replicates;
  GivenUnits units;
  Assignments base;
  std::vector<Block> blocks;
};

/// Whether a sweep may have this name, which becomes that of a folder.
bool is_sweep_name(const std::string& name);

/// Reads the schema of a sweep file, noting every problem on the way.
SweepDefinition read_definition(const Json& file, Diagnostics& diagnostics);

/// Points of `block` without replicates; 2^64 - 1 if there are more.
std::uint64_t point_count(const Block& block);

}  // namespace grainsweep
