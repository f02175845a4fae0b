// Broad phase: which grains may touch soon.
//
// A list of candidates stays good while no grain has moved, since it was looked up, by more than
// half of what the list reaches beyond near. Grains that have moved further are strays: while they
// are few they are looked up singly, and the grains that they have come near to are added to the
// list.
//
// Grains a hundredth as large as the reach beyond near would have a hundred times more pairs than
// they touch: pairs of small grains are listed less far, and these grains stray sooner.
//
// Grains are searched for by level of size, each level in a grid of cells that just hold its own
// grains; then every level's grains are looked up in the grids of the larger ones. With one grid of
// large cells a grain ten times smaller would meet a thousand others in each.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include "engine/broad/grid.hpp"
#include "engine/broad/pair_index.hpp"
#include "engine/broad/size_levels.hpp"
#include "engine/context.hpp"
#include "engine/scene/bed.hpp"
#include "kernels/kernels.hpp"

namespace grainsweep {

/// Lowest and highest centre, d.
struct Heights {
  double bottom = std::numeric_limits<double>::max();
  double top = -std::numeric_limits<double>::max();
};

/// Memory of a search across levels: the spheres of one level on their way through another's grid.
struct QueryColumns {
  std::vector<float> x, y, z, radius;
  std::vector<std::int32_t> cell;
};

/// Where strays are looked up: all members where they were when this was filled, and those that
/// have been looked up since, where they were then.
struct LookupGrids {
  bool is_filled = false;
  GridColumns of_all, of_moved;
  std::vector<std::int32_t> moved;
  std::vector<std::uint8_t> has_moved;  ///< of each grain
};

struct Candidates {
  bool is_listed = false;    ///< whether what follows is of this bed
  double reach = 0.0;        ///< every pair with a gap below it (less what the levels of its grains
                             ///< are listed less far), and every wall, is listed, d
  double slack = 0.0;        ///< what rounding may add to a distance in a search, d
  Heights lookup;            ///< heights between which a grain may be looked up, d
  std::size_t searched = 0;  ///< pairs that the search found
  std::vector<GrainPair> pairs;  ///< each once, a < b: first in the order of the search grids, then
                                 ///< those that strays have added
  /// Grains that come within reach of each wall, ascending; then those that strays have added.
  std::vector<std::vector<std::int32_t>> walls;
  std::vector<Record<double>> built_at;  ///< where each grain was looked up
  std::vector<std::int32_t> members;     ///< grains that can be found, ascending
  std::vector<SizeLevel> levels;         ///< from large to small, at least one
  QueryColumns queries;
  std::vector<Record<double>> balls;          ///< memory of balls_of
  std::vector<std::vector<GrainPair>> found;  ///< memory of the parts of a search
  std::vector<std::size_t> found_begin;       ///< where each part's pairs go
  std::vector<std::int32_t> strays;           ///< memory of complete_candidates
  std::vector<GrainPair> met;                 ///< pairs that they come near in
  LookupGrids lookup_grids;
  PairIndex index;          ///< of the pairs
  bool is_indexed = false;  ///< whether it knows them
};

/// Gap below which two balls of these radii count as near, d; no smaller for larger balls.
using PairReach = std::function<double(double, double)>;

/// Lists all pairs whose balls have a gap below what `reach_of` says of them, some with a gap below
/// what it says of larger ones, and walls, which count as infinite balls; but no pairs of two
/// sleeping grains, nor of a sleeping grain and a wall. The bed must be wrapped; a periodic axis
/// must be at least two largest diameters and reaches long. Where the reach depends on the size of
/// the balls the list is for use at once.
void find_candidates(const Balls& balls, const PairReach& reach_of, const ExecutionContext& context,
                     Candidates& candidates);

/// The same with one reach for all, d.
inline void find_candidates(const Balls& balls, double reach, const ExecutionContext& context,
                            Candidates& candidates) {
  find_candidates(
      balls, [=](double, double) { return reach; }, context, candidates);
}
/// Whether the list still holds every pair and wall with a gap below `near` < reach: no grain has
/// moved since it was looked up by more than half of what its pairs are listed further.
bool still_complete(const Balls& balls, double near, const Candidates& candidates);

/// If the list may be missing a candidate with a gap below `near`, lists those with a gap below
/// near + margin anew and wraps the bed. Returns whether it did.
template <class Kind>
bool renew_candidates(double near, double margin, const ExecutionContext& context, Bed<Kind>& bed,
                      Candidates& candidates) {
  if (candidates.is_listed && still_complete(balls_of(bed, candidates.balls), near, candidates)) {
    return false;
  }
  wrap(bed, context.loop);
  find_candidates(balls_of(bed, candidates.balls), near + margin, context, candidates);
  candidates.is_listed = true;
  return true;
}

/// Completes the list of a bed of spheres for all pairs and walls with a gap below `near`. Strays
/// are wrapped and looked up singly while they are few; else the whole bed is wrapped and listed
/// anew as far as near + margin, with a smaller margin for small grains. A pair that is no longer
/// near stays in the list until it is made anew. While a list stands `near` must not rise: pairs of
/// small grains are looked up only as far as `near` was when the list was made. Returns whether the
/// list is a new one.
bool complete_candidates(double near, double margin, const ExecutionContext& context,
                         SphereBed& bed, Candidates& candidates);

}  // namespace grainsweep
