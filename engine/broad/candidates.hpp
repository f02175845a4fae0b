// Broad phase: which grains may touch soon.
//
// A list of candidates stays good while no two grains that are near each other have moved closer by
// more than the list's margin. What counts is their relative motion: a bed that falls as one needs
// no new list.
//
// Grains are searched for by level of size, each level in a grid of cells that just hold its own
// grains; then every level's grains are looked up in the grids of the larger ones. With one grid of
// large cells a grain ten times smaller would meet a thousand others in each.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/broad/grid.hpp"
#include "engine/context.hpp"
#include "engine/scene/bed.hpp"
#include "kernels/kernels.hpp"

namespace grainsweep {

/// Grains that come within reach of one wall.
struct WallCandidates {
  std::vector<std::int32_t> grains;  ///< ascending
};

/// How the grains of one layer have moved since the list was made, and where they are now.
struct Extent {
  double low[3];  ///< smallest box around their displacements, d
  double high[3];
  double bottom;  ///< lowest and highest centre, d
  double top;
  bool empty;
};

/// Grains of similar size and their search grid: radii from the largest down to half of it.
struct SizeLevel {
  double largest_radius = 0.0;        ///< d
  std::vector<std::int32_t> members;  ///< ascending
  Cells cells;
  GridColumns grid;
};

/// Memory of a search across levels: the spheres of one level on their way through another's grid.
struct QueryColumns {
  std::vector<float> x, y, z, radius;
  std::vector<std::int32_t> cell;
};

struct Candidates {
  bool is_listed = false;        ///< whether what follows is of this bed
  double reach = 0.0;            ///< every pair and wall with a gap below it is listed, d
  double largest_radius = 0.0;   ///< d
  std::vector<GrainPair> pairs;  ///< each once, a < b, in the order of the search grids
  std::vector<WallCandidates> walls;
  std::vector<Record<double>> built_at;  ///< positions of the grains when the list was made
  std::vector<std::int32_t> layer;       ///< horizontal layer of each grain at that time
  std::vector<Extent> layers;            ///< memory of `still_complete`, one entry per layer
  std::vector<SizeLevel> levels;         ///< from large to small, at least one
  QueryColumns queries;
  std::vector<Record<double>> balls;          ///< memory of balls_of
  std::vector<std::vector<GrainPair>> found;  ///< memory of the parts of a search
  std::vector<std::size_t> found_begin;       ///< where each part's pairs go
};

/// Lists all pairs and walls whose balls have a gap below `reach`, but for those of grains that
/// sleep among each other and with walls. The bed must be wrapped; a periodic axis must be at least
/// two largest diameters and reaches long.
void find_candidates(const Balls& balls, double reach, const ExecutionContext& context,
                     Candidates& candidates);

/// Whether the list still holds every pair and wall with a gap below `near` < reach. Pairs are
/// judged in layers one cell high: no two grains of adjacent layers may have moved relative to each
/// other by more than reach - near since the list was made, and grains of layers further apart must
/// still be out of reach by their heights alone.
bool still_complete(const Balls& balls, double near, Candidates& candidates);

/// Lists the candidates with a gap below near + margin anew, and wraps the bed, if the list may
/// lack one with a gap below `near`. Returns whether it did.
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

}  // namespace grainsweep
