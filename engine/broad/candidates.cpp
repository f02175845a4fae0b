#include "engine/broad/candidates.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "engine/units.hpp"

namespace grainsweep {

namespace {

void include(const Record<double>& ball, Heights& heights) {
  heights.bottom = std::min(heights.bottom, ball.z);
  heights.top = std::max(heights.top, ball.z);
}

/// Heights of the grains that are awake.
Heights heights_of(const Balls& balls) {
  Heights heights;
  for (std::size_t i = balls.bed.first_awake; i < balls.bed.grains(); ++i) {
    if (!balls.bed.is_asleep(i)) include(balls.ball[i], heights);
  }
  return heights;
}

/// All grains awake, and the sleeping ones that a grain awake may touch: those at heights from
/// `lowest` on.
void choose_members(const Balls& balls, double reach, double lowest, Candidates& candidates) {
  const double largest = largest_radius(balls, infinity);
  candidates.members.clear();
  for (std::size_t i = 0; i < balls.bed.grains(); ++i) {
    const Record<double>& ball = balls.ball[i];
    if (balls.bed.is_asleep(i) && ball.z < lowest - (ball.w + largest + reach)) continue;
    candidates.members.push_back(static_cast<std::int32_t>(i));
  }
}

Heights heights_of(const Balls& balls, const std::vector<std::int32_t>& members) {
  Heights heights;
  for (const std::int32_t grain : members) {
    include(balls.ball[static_cast<std::size_t>(grain)], heights);
  }
  return heights;
}

/// What rounding positions to f32 can add to a distance, d: three roundings of the largest number.
double rounding_slack(const Balls& balls, const Heights& heights) {
  const double extent = std::max(
      {2.0 * balls.bed.box.length, 2.0 * balls.bed.box.width, heights.top - heights.bottom});
  return 8.0 * static_cast<double>(std::numeric_limits<float>::epsilon()) * extent;
}

/// How far apart the grains of a pair are listed, d, by their levels.
using LevelReach = std::function<double(const SizeLevel&, const SizeLevel&)>;

/// Fills the grid of every level; all have the same origin. No pair with a gap below its reach and
/// `slack` lies further apart than in adjacent cells.
void fill_grids(const Balls& balls, const Heights& heights, const LevelReach& reach_of,
                double slack, const ParallelFor& loop, std::vector<SizeLevel>& levels) {
  for (SizeLevel& level : levels) {
    const double least = 2.0 * level.largest_radius + (reach_of(level, level) + slack);
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

/// Grains as they look for neighbours in a grid whose cells just hold them or larger ones.
void fill_queries(const Balls& balls, const std::vector<std::int32_t>& grains, const Cells& coarse,
                  QueryColumns& queries) {
  queries.x.clear(), queries.y.clear(), queries.z.clear(), queries.radius.clear();
  queries.cell.clear();
  for (const std::int32_t grain : grains) {
    const Record<double>& p = balls.ball[static_cast<std::size_t>(grain)];
    queries.x.push_back(static_cast<float>(p.x));
    queries.y.push_back(static_cast<float>(p.y));
    queries.z.push_back(static_cast<float>(p.z - coarse.origin_z));
    queries.radius.push_back(static_cast<float>(p.w));
    queries.cell.push_back(coarse.cell_of(p));
  }
}

/// A share of the grains that these columns were filled with.
SphereQueries view_of(const QueryColumns& queries, const std::vector<std::int32_t>& grains,
                      IndexRange share) {
  return {queries.x.data() + share.first, queries.y.data() + share.first,
          queries.z.data() + share.first, queries.radius.data() + share.first,
          grains.data() + share.first,    queries.cell.data() + share.first,
          share.last - share.first};
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
  fill_queries(balls, fine.members, coarse.cells, candidates.queries);
  const SphereGrid grid = view_of(coarse.grid, coarse.cells, reach);
  const std::size_t parts = parts_of(fine);
  append_parts(
      context.loop, parts, 2 * fine.members.size(),
      [&](std::size_t part, GrainPair* pairs, std::size_t capacity) {
        const SphereQueries queries =
            view_of(candidates.queries, fine.members, chunk_of(fine.members.size(), part, parts));
        return context.kernels.sphere_pairs_across(grid, queries, pairs, capacity);
      },
      candidates);
}

void list_pairs(const Balls& balls, const LevelReach& reach_of, const ExecutionContext& context,
                Candidates& candidates) {
  candidates.pairs.clear();
  const auto reach = [&](const SizeLevel& one, const SizeLevel& other) {
    return static_cast<float>(reach_of(one, other) + candidates.slack);
  };
  const std::vector<SizeLevel>& levels = candidates.levels;
  for (std::size_t k = 0; k < levels.size(); ++k) {
    const SizeLevel& level = levels[k];
    list_pairs_within(level, reach(level, level), context, candidates);
    for (std::size_t coarse = 0; coarse < k; ++coarse) {
      list_pairs_across(balls, level, levels[coarse], reach(level, levels[coarse]), context,
                        candidates);
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
    std::vector<std::int32_t>& near = candidates.walls[k];
    near.clear();
    for (std::size_t i = 0; i < balls.bed.grains(); ++i) {
      if (balls.bed.is_asleep(i)) continue;
      if (balls.bed.walls[k].gap(balls.ball[i]) < candidates.reach) {
        near.push_back(static_cast<std::int32_t>(i));
      }
    }
  }
}

void remember_positions(const Balls& balls, const ParallelFor& loop, Candidates& candidates) {
  candidates.built_at.resize(balls.bed.grains());
  parallel_chunks(
      loop, balls.bed.grains(), balls.bed.subdomains, [&](std::size_t, IndexRange share) {
        std::copy(balls.ball.begin() + static_cast<std::ptrdiff_t>(share.first),
                  balls.ball.begin() + static_cast<std::ptrdiff_t>(share.last),
                  candidates.built_at.begin() + static_cast<std::ptrdiff_t>(share.first));
      });
}

// ---- strays ----

/// Whether a grain has moved from where it was looked up by more than half of what its pairs are
/// listed beyond `near`; if they are listed no further, it is a stray even where it stays.
bool is_stray(const Record<double>& now, const Record<double>& then, double near,
              const Candidates& candidates) {
  const double less = candidates.levels[level_of(now.w, candidates.levels)].less;
  const double leash = 0.5 * (candidates.reach - near) - less;
  const double x = now.x - then.x, y = now.y - then.y, z = now.z - then.z;
  return leash < 0.0 || x * x + y * y + z * z > leash * leash;
}

void find_strays(const Balls& balls, double near, Candidates& candidates) {
  candidates.strays.clear();
  for (std::size_t i = 0; i < balls.bed.grains(); ++i) {
    if (is_stray(balls.ball[i], candidates.built_at[i], near, candidates)) {
      candidates.strays.push_back(static_cast<std::int32_t>(i));
    }
  }
}

/// Whether to look strays up singly: if they are so few that it costs less than a search, if the
/// list has not grown much by it, and if the grids reach as far as strays have moved.
bool may_look_up(const SphereBed& bed, const Candidates& candidates) {
  const Cells& cells = candidates.levels.front().cells;
  const double members = static_cast<double>(candidates.members.size());
  const double in_a_cell =
      members / (static_cast<double>(cells.inner_x) * cells.inner_y * cells.inner_z);
  const std::size_t added = candidates.pairs.size() - candidates.searched;
  return static_cast<double>(candidates.strays.size()) * std::max(1.0, in_a_cell) < 0.5 * members &&
         4 * added <= candidates.searched &&
         std::all_of(candidates.strays.begin(), candidates.strays.end(), [&](std::int32_t grain) {
           const double z = bed.position[static_cast<std::size_t>(grain)].z;
           return z >= candidates.lookup.bottom && z <= candidates.lookup.top;
         });
}

/// Whether a pair lies further apart, where its grains were looked up, than its sizes are listed.
bool is_far(const SphereBed& bed, GrainPair pair, const Candidates& candidates) {
  const Record<double>& p = candidates.built_at[static_cast<std::size_t>(pair.a)];
  const Record<double>& q = candidates.built_at[static_cast<std::size_t>(pair.b)];
  const std::vector<SizeLevel>& levels = candidates.levels;
  const double x = nearest_image(p.x - q.x, bed.box.period_x());
  const double y = nearest_image(p.y - q.y, bed.box.period_y()), z = p.z - q.z;
  const double less = levels[level_of(p.w, levels)].less + levels[level_of(q.w, levels)].less;
  return std::sqrt(x * x + y * y + z * z) - p.w - q.w >= candidates.reach - less;
}

/// Looks the strays up once more: from now on they are where they are now. The grid of all members
/// is filled anew once many have moved in it; until then those that have are in a grid of their
/// own.
void move_strays(const ExecutionContext& context, SphereBed& bed, Candidates& candidates) {
  LookupGrids& grids = candidates.lookup_grids;
  const Cells& cells = candidates.levels.front().cells;
  const auto fill = [&](const std::vector<std::int32_t>& grains, GridColumns& grid) {
    fill_columns({bed, candidates.built_at}, grains, cells, context.loop, grid);
  };
  for (const std::int32_t grain : candidates.strays) {
    const auto i = static_cast<std::size_t>(grain);
    wrap(bed.box, bed.position[i]);
    candidates.built_at[i] = bed.position[i];
    if (!grids.is_filled || grids.has_moved[i] != 0) continue;
    grids.has_moved[i] = 1;
    grids.moved.push_back(grain);
  }
  constexpr std::size_t many = 8;  // one in so many
  if (!grids.is_filled || many * grids.moved.size() > candidates.members.size()) {
    fill(candidates.members, grids.of_all);
    grids.has_moved.assign(bed.grains(), 0);
    grids.moved.clear();
    grids.is_filled = true;
  }
  fill(grids.moved, grids.of_moved);
}

/// Lists the pairs that strays have in a grid.
void meet(const GridColumns& grid, const ExecutionContext& context, Candidates& candidates) {
  const SphereGrid view = view_of(grid, candidates.levels.front().cells,
                                  static_cast<float>(candidates.reach + candidates.slack));
  const SphereQueries queries =
      view_of(candidates.queries, candidates.strays, {0, candidates.strays.size()});
  append_found(
      [&](GrainPair* pairs, std::size_t capacity) {
        return context.kernels.sphere_pairs_across(view, queries, pairs, capacity);
      },
      16 * candidates.strays.size(), candidates.met);
}

/// Keeps those of the pairs met that are not in the list, each once, by their grains.
void keep_unlisted(Candidates& candidates) {
  std::vector<GrainPair>& met = candidates.met;
  if (!candidates.is_indexed) candidates.index.assign(candidates.built_at.size(), candidates.pairs);
  candidates.is_indexed = true;
  std::erase_if(met,
                [&](GrainPair pair) { return pair.a == pair.b || candidates.index.holds(pair); });
  std::sort(met.begin(), met.end(),
            [](GrainPair p, GrainPair q) { return p.a != q.a ? p.a < q.a : p.b < q.b; });
  const auto is_same = [](GrainPair p, GrainPair q) { return p.a == q.a && p.b == q.b; };
  met.erase(std::unique(met.begin(), met.end(), is_same), met.end());
}

/// Lists the walls that strays have come within reach of.
void add_walls(const SphereBed& bed, Candidates& candidates) {
  for (std::size_t k = 0; k < bed.walls.size(); ++k) {
    std::vector<std::int32_t>& near = candidates.walls[k];
    for (const std::int32_t grain : candidates.strays) {
      const Record<double>& p = bed.position[static_cast<std::size_t>(grain)];
      if (bed.walls[k].gap(p) < candidates.reach &&
          std::find(near.begin(), near.end(), grain) == near.end()) {
        near.push_back(grain);
      }
    }
  }
}

/// Lists the pairs that strays have come near in.
void look_up(const ExecutionContext& context, SphereBed& bed, Candidates& candidates) {
  move_strays(context, bed, candidates);
  const LookupGrids& grids = candidates.lookup_grids;
  const auto has_moved = [&](std::int32_t grain) {
    return grids.has_moved[static_cast<std::size_t>(grain)] != 0;
  };
  fill_queries({bed, candidates.built_at}, candidates.strays, candidates.levels.front().cells,
               candidates.queries);
  candidates.met.clear();
  meet(grids.of_all, context, candidates);
  std::erase_if(candidates.met, [&](GrainPair p) { return has_moved(p.a) && has_moved(p.b); });
  meet(grids.of_moved, context, candidates);
  if (candidates.levels.back().less > 0.0) {
    std::erase_if(candidates.met, [&](GrainPair pair) { return is_far(bed, pair, candidates); });
  }
  keep_unlisted(candidates);
  for (const GrainPair pair : candidates.met) {
    candidates.pairs.push_back(pair);
    candidates.index.add(pair);
  }
  add_walls(bed, candidates);
}

/// Lists all pairs with a gap below `reach_of` their levels, and walls with one below `reach`.
/// Small grains get less of `margin`.
void list_candidates(const Balls& balls, double reach, double margin, const LevelReach& reach_of,
                     const ExecutionContext& context, Candidates& candidates) {
  constexpr double lookup_slack = 0.5;  // d
  candidates.reach = reach;
  const Heights awake = heights_of(balls);
  candidates.lookup = {awake.bottom - lookup_slack, awake.top + lookup_slack};
  choose_members(balls, reach, candidates.lookup.bottom, candidates);
  choose_levels(balls, candidates.members, margin, candidates.levels);
  const Heights heights = heights_of(balls, candidates.members);
  candidates.slack = rounding_slack(balls, heights);
  fill_grids(balls, heights, reach_of, 2.0 * candidates.slack, context.loop, candidates.levels);
  list_pairs(balls, reach_of, context, candidates);
  list_walls(balls, candidates);
  remember_positions(balls, context.loop, candidates);
  candidates.searched = candidates.pairs.size();
  candidates.is_indexed = false;
  candidates.lookup_grids.is_filled = false;
}

}  // namespace

void find_candidates(const Balls& balls, const PairReach& reach_of, const ExecutionContext& context,
                     Candidates& candidates) {
  const auto by_size = [&](const SizeLevel& one, const SizeLevel& other) {
    return reach_of(one.largest_radius, other.largest_radius);
  };
  list_candidates(balls, reach_of(infinity, infinity), 0.0, by_size, context, candidates);
}

bool still_complete(const Balls& balls, double near, const Candidates& candidates) {
  for (std::size_t i = 0; i < balls.bed.grains(); ++i) {
    if (is_stray(balls.ball[i], candidates.built_at[i], near, candidates)) return false;
  }
  return true;
}

bool complete_candidates(double near, double margin, const ExecutionContext& context,
                         SphereBed& bed, Candidates& candidates) {
  if (candidates.is_listed) {
    find_strays({bed, bed.position}, near, candidates);
    if (candidates.strays.empty()) return false;
    if (may_look_up(bed, candidates)) {
      look_up(context, bed, candidates);
      return false;
    }
  }
  wrap(bed, context.loop);
  const double reach = near + margin;
  const auto less_of_small = [=](const SizeLevel& one, const SizeLevel& other) {
    return reach - one.less - other.less;
  };
  list_candidates({bed, bed.position}, reach, margin, less_of_small, context, candidates);
  candidates.is_listed = true;
  return true;
}

}  // namespace grainsweep
