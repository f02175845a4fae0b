#include "engine/broad/candidates.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace grainsweep {

namespace {

/// Levels of sizes told apart; smaller grains share the last one.
constexpr std::size_t max_levels = 8;

/// Lowest and highest centre, d.
struct Heights {
  double bottom = std::numeric_limits<double>::max();
  double top = -std::numeric_limits<double>::max();
};

void include(const Record<double>& ball, Heights& heights) {
  heights.bottom = std::min(heights.bottom, ball.z);
  heights.top = std::max(heights.top, ball.z);
}

/// Of the grains that are awake.
Heights heights_of(const Balls& balls) {
  Heights heights;
  for (std::size_t i = balls.bed.first_awake; i < balls.bed.grains(); ++i) {
    if (!balls.bed.is_asleep(i)) include(balls.ball[i], heights);
  }
  return heights;
}

/// Largest radius below `below`, d; 0 if there is none.
double largest_radius(const Balls& balls, double below) {
  double largest = 0.0;
  for (std::size_t i = 0; i < balls.bed.grains(); ++i) {
    const double radius = balls.ball[i].w;
    if (radius < below) largest = std::max(largest, radius);
  }
  return largest;
}

/// Sorts the grains into levels. A level holds radii from its largest down to half of that, so that
/// a bed of one size has one level; the last one holds all that is left. Of grains that sleep only
/// those that one awake may touch; `heights` grow by them.
void choose_levels(const Balls& balls, double reach, Heights& heights,
                   std::vector<SizeLevel>& levels) {
  const double lowest_awake = heights.bottom;
  std::size_t count = 0;
  double below = std::numeric_limits<double>::infinity();
  for (double largest = largest_radius(balls, below); count == 0 || largest > 0.0;
       largest = largest_radius(balls, below)) {
    if (levels.size() <= count) levels.emplace_back();
    levels[count].largest_radius = largest;
    levels[count].members.clear();
    below = ++count < max_levels ? std::min(below, 0.5 * largest) : 0.0;
  }
  levels.resize(count);
  for (std::size_t i = 0; i < balls.bed.grains(); ++i) {
    if (balls.bed.is_asleep(i)) {
      const double near = balls.ball[i].w + levels.front().largest_radius + reach;
      if (balls.ball[i].z < lowest_awake - near) continue;
      include(balls.ball[i], heights);
    }
    std::size_t level = 0;
    while (level + 1 < count && balls.ball[i].w < 0.5 * levels[level].largest_radius) ++level;
    levels[level].members.push_back(static_cast<std::int32_t>(i));
  }
}

/// What rounding positions to f32 can add to a distance, d: three roundings of the largest number.
double rounding_slack(const Balls& balls, const Heights& heights) {
  const double extent = std::max(
      {2.0 * balls.bed.box.length, 2.0 * balls.bed.box.width, heights.top - heights.bottom});
  return 8.0 * static_cast<double>(std::numeric_limits<float>::epsilon()) * extent;
}

/// Fills the grid of every level; all have the same origin. No pair with a gap below `reach` lies
/// further apart than in adjacent cells.
void fill_grids(const Balls& balls, const Heights& heights, double reach, const ParallelFor& loop,
                std::vector<SizeLevel>& levels) {
  for (SizeLevel& level : levels) {
    const double least = 2.0 * level.largest_radius + reach;
    level.cells =
        make_cells(balls.bed.box, heights.bottom, heights.top, least, level.members.size());
    fill_columns(balls, level.members, level.cells, loop, level.grid);
  }
}

/// Appends what `find(pairs, capacity)` writes, with more room if it needs more.
template <class Find>
void append_found(Find find, std::size_t expected, std::vector<GrainPair>& pairs) {
  const std::size_t before = pairs.size();
  pairs.resize(std::max(pairs.capacity(), before + expected));
  std::size_t found = find(pairs.data() + before, pairs.size() - before);
  if (found > pairs.size() - before) {
    pairs.resize(before + found + found / 4);
    found = find(pairs.data() + before, pairs.size() - before);
  }
  pairs.resize(before + found);
}

/// How many parts a level's search is divided into.
std::size_t parts_of(const SizeLevel& level) {
  constexpr std::size_t grains_of_part = 4000;
  const std::size_t parts = level.members.size() / grains_of_part;
  return parts < 4 ? 1 : std::min(parts, static_cast<std::size_t>(level.cells.inner_z));
}

/// Appends what was found in each part.
void join_found(const ParallelFor& loop, std::size_t parts, Candidates& candidates) {
  auto& begin = candidates.found_begin;
  begin.assign(1, candidates.pairs.size());
  for (std::size_t part = 0; part < parts; ++part) {
    begin.push_back(begin.back() + candidates.found[part].size());
  }
  candidates.pairs.resize(begin.back());
  parallel_for(loop, parts, [&](std::size_t part) {
    std::copy(candidates.found[part].begin(), candidates.found[part].end(),
              candidates.pairs.data() + begin[part]);
  });
}

/// Appends what `find(part, pairs, capacity)` writes for each part, in the order of the parts.
template <class Find>
void append_parts(const ParallelFor& loop, std::size_t parts, std::size_t expected, Find find,
                  Candidates& candidates) {
  auto& found = candidates.found;
  found.resize(std::max(found.size(), parts));
  parallel_for(loop, parts, [&](std::size_t part) {
    found[part].clear();
    append_found(
        [&](GrainPair* pairs, std::size_t capacity) { return find(part, pairs, capacity); },
        expected / parts + block_width, found[part]);
  });
  join_found(loop, parts, candidates);
}

/// Layers first .. last of a grid; the layer above them serves as border.
SphereGrid layers_of(SphereGrid grid, IndexRange layers) {
  grid.cell_begin += layers.first * static_cast<std::size_t>(grid.cells_x * grid.cells_y);
  grid.cells_z = static_cast<std::int32_t>(layers.last - layers.first) + 2;
  return grid;
}

/// The members of a level as they look for neighbours in the grid of a coarser one.
void fill_queries(const Balls& balls, const SizeLevel& level, const Cells& coarse,
                  QueryColumns& queries) {
  queries.x.clear(), queries.y.clear(), queries.z.clear(), queries.radius.clear();
  queries.cell.clear();
  for (const std::int32_t grain : level.members) {
    const Record<double>& p = balls.ball[static_cast<std::size_t>(grain)];
    queries.x.push_back(static_cast<float>(p.x));
    queries.y.push_back(static_cast<float>(p.y));
    queries.z.push_back(static_cast<float>(p.z - coarse.origin_z));
    queries.radius.push_back(static_cast<float>(p.w));
    queries.cell.push_back(coarse.cell_of(p));
  }
}

/// Pairs of grains of one level.
void list_pairs_within(const SizeLevel& level, float reach, const ExecutionContext& context,
                       Candidates& candidates) {
  const SphereGrid grid = view_of(level.grid, level.cells, reach);
  const std::size_t parts = parts_of(level);
  append_parts(
      context.loop, parts, 6 * level.members.size(),
      [&](std::size_t part, GrainPair* pairs, std::size_t capacity) {
        const IndexRange layers =
            chunk_of(static_cast<std::size_t>(level.cells.inner_z), part, parts);
        return context.kernels.sphere_pairs(layers_of(grid, layers), pairs, capacity);
      },
      candidates);
}

/// Pairs of a level's grains with those of a coarser level.
void list_pairs_across(const Balls& balls, const SizeLevel& fine, const SizeLevel& coarse,
                       float reach, const ExecutionContext& context, Candidates& candidates) {
  QueryColumns& q = candidates.queries;
  fill_queries(balls, fine, coarse.cells, q);
  const SphereGrid grid = view_of(coarse.grid, coarse.cells, reach);
  const std::size_t parts = parts_of(fine);
  append_parts(
      context.loop, parts, 2 * fine.members.size(),
      [&](std::size_t part, GrainPair* pairs, std::size_t capacity) {
        const IndexRange share = chunk_of(fine.members.size(), part, parts);
        const SphereQueries queries{
            q.x.data() + share.first,          q.y.data() + share.first,
            q.z.data() + share.first,          q.radius.data() + share.first,
            fine.members.data() + share.first, q.cell.data() + share.first,
            share.last - share.first};
        return context.kernels.sphere_pairs_across(grid, queries, pairs, capacity);
      },
      candidates);
}

void list_pairs(const Balls& balls, float reach, const ExecutionContext& context,
                Candidates& candidates) {
  candidates.pairs.clear();
  const std::vector<SizeLevel>& levels = candidates.levels;
  for (std::size_t k = 0; k < levels.size(); ++k) {
    const SizeLevel& level = levels[k];
    list_pairs_within(level, reach, context, candidates);
    for (std::size_t coarse = 0; coarse < k; ++coarse) {
      list_pairs_across(balls, level, levels[coarse], reach, context, candidates);
    }
  }
  if (!balls.bed.asleep.empty()) {
    std::erase_if(candidates.pairs, [&](const GrainPair& pair) {
      return balls.bed.is_asleep(static_cast<std::size_t>(pair.a)) &&
             balls.bed.is_asleep(static_cast<std::size_t>(pair.b));
    });
  }
}

void list_walls(const Balls& balls, Candidates& candidates) {
  candidates.walls.resize(balls.bed.walls.size());
  for (std::size_t k = 0; k < balls.bed.walls.size(); ++k) {
    WallCandidates& near = candidates.walls[k];
    near.grains.clear();
    for (std::size_t i = 0; i < balls.bed.grains(); ++i) {
      if (balls.bed.is_asleep(i)) continue;
      if (balls.bed.walls[k].gap(balls.ball[i]) < candidates.reach) {
        near.grains.push_back(static_cast<std::int32_t>(i));
      }
    }
  }
}

void remember_positions(const Balls& balls, const ParallelFor& loop, Candidates& candidates) {
  const Cells& cells = candidates.levels.front().cells;
  candidates.built_at.resize(balls.bed.grains());
  candidates.layers.resize(static_cast<std::size_t>(cells.inner_z));
  candidates.layer.resize(balls.bed.grains());
  parallel_chunks(loop, balls.bed.grains(), balls.bed.subdomains,
                  [&](std::size_t, IndexRange share) {
                    for (std::size_t i = share.first; i < share.last; ++i) {
                      candidates.built_at[i] = balls.ball[i];
                      candidates.layer[i] = cells.layer_of(balls.ball[i]);
                    }
                  });
}

void include(Extent& extent, const Record<double>& then, const Record<double>& now) {
  const double at[3] = {now.x - then.x, now.y - then.y, now.z - then.z};
  for (int k = 0; k < 3; ++k) {
    extent.low[k] = extent.empty ? at[k] : std::min(extent.low[k], at[k]);
    extent.high[k] = extent.empty ? at[k] : std::max(extent.high[k], at[k]);
  }
  extent.bottom = extent.empty ? now.z : std::min(extent.bottom, now.z);
  extent.top = extent.empty ? now.z : std::max(extent.top, now.z);
  extent.empty = false;
}

void measure_layers(const Balls& balls, Candidates& candidates) {
  std::fill(candidates.layers.begin(), candidates.layers.end(), Extent{{}, {}, 0.0, 0.0, true});
  for (std::size_t i = 0; i < balls.bed.grains(); ++i) {
    include(candidates.layers[static_cast<std::size_t>(candidates.layer[i])],
            candidates.built_at[i], balls.ball[i]);
  }
}

double diagonal_of_both(const Extent& a, const Extent& b) {
  double squared = 0.0;
  for (int k = 0; k < 3; ++k) {
    const double low = std::min(a.empty ? b.low[k] : a.low[k], b.empty ? a.low[k] : b.low[k]);
    const double high = std::max(a.empty ? b.high[k] : a.high[k], b.empty ? a.high[k] : b.high[k]);
    squared += (high - low) * (high - low);
  }
  return std::sqrt(squared);
}

/// Largest relative motion of two grains in the same or in adjacent layers, d.
double relative_motion(const std::vector<Extent>& layers) {
  double worst = 0.0;
  for (std::size_t k = 0; k < layers.size(); ++k) {
    const Extent& above = layers[std::min(k + 1, layers.size() - 1)];
    worst = std::max(worst, diagonal_of_both(layers[k], above));
  }
  return worst;
}

/// Least difference in height of two grains that are not in the same or in adjacent layers, d.
double min_rise(const std::vector<Extent>& layers) {
  constexpr double beyond_all = std::numeric_limits<double>::max();
  double least = beyond_all, top = -beyond_all;
  for (std::size_t k = 2; k < layers.size(); ++k) {
    top = layers[k - 2].empty ? top : std::max(top, layers[k - 2].top);
    least = layers[k].empty ? least : std::min(least, layers[k].bottom - top);
  }
  return least;
}

/// Whether a grain that was out of a wall's reach has come near it.
bool has_newcomer(const Balls& balls, const Wall& wall, double near, const Candidates& candidates) {
  for (std::size_t i = 0; i < balls.bed.grains(); ++i) {
    if (wall.gap(balls.ball[i]) < near && wall.gap(candidates.built_at[i]) >= candidates.reach) {
      return true;
    }
  }
  return false;
}

}  // namespace

void find_candidates(const Balls& balls, double reach, const ExecutionContext& context,
                     Candidates& candidates) {
  candidates.reach = reach;
  Heights heights = heights_of(balls);
  choose_levels(balls, reach, heights, candidates.levels);
  candidates.largest_radius = candidates.levels.front().largest_radius;
  const double slack = rounding_slack(balls, heights);
  fill_grids(balls, heights, reach + 2.0 * slack, context.loop, candidates.levels);
  list_pairs(balls, static_cast<float>(reach + slack), context, candidates);
  list_walls(balls, candidates);
  remember_positions(balls, context.loop, candidates);
}

bool still_complete(const Balls& balls, double near, Candidates& candidates) {
  measure_layers(balls, candidates);
  return relative_motion(candidates.layers) <= candidates.reach - near &&
         min_rise(candidates.layers) >= 2.0 * candidates.largest_radius + near &&
         std::none_of(balls.bed.walls.begin(), balls.bed.walls.end(), [&](const Wall& wall) {
           return has_newcomer(balls, wall, near, candidates);
         });
}

}  // namespace grainsweep
