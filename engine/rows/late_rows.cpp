#include "engine/rows/late_rows.hpp"

#include <algorithm>
#include <utility>

#include "engine/rows/block_writer.hpp"

namespace grainsweep {

namespace {

/// How much rounding to f32 may add to a gap, d.
constexpr double gap_rounding = 1e-7;

template <class Real>
void make_void(const SphereBed& bed, std::size_t lane, RowBlock<Real>& block) {
  block.set_grains(lane, bed.void_a(), bed.void_b());
}

template <class Real>
void add_spare(const SphereBed& bed, GrainPair pair, Spares<Real>& spares) {
  const std::size_t lane = spares.count % block_width;
  if (lane == 0) {
    spares.blocks.emplace_back();
    for (std::size_t k = 0; k < block_width; ++k) make_void(bed, k, spares.blocks.back());
  }
  spares.blocks.back().set_grains(lane, pair.a, pair.b);
  ++spares.count;
}

template <class Real>
void measure(const SphereBed& bed, const ExecutionContext& context,
             SphereContacts<Real>& contacts) {
  std::vector<RowBlock<Real>>& blocks = contacts.spares.blocks;
  measure_blocks(bed, context, 1.0, blocks.data(), blocks.size(), contacts.sunk);
}

/// Calls visit(lane) for the lanes with a gap below `reach`.
template <class Real, class Visit>
void visit_near(double reach, RowBlock<Real>& block, const Visit& visit) {
  const auto limit = static_cast<Real>(reach + gap_rounding);
  unsigned near = 0;
  for (std::size_t lane = 0; lane < block_width; ++lane) {
    near |= (block.gap[lane] < limit ? 1U : 0U) << lane;
  }
  for (; near != 0; near &= near - 1) visit(static_cast<std::size_t>(__builtin_ctz(near)));
}

/// The first unused lane of a block that holds neither a nor b; block_width if there is none.
template <class Real>
std::size_t free_lane(const SphereBed& bed, const RowBlock<Real>& block, GrainPair pair) {
  std::size_t lane = 0;
  for (; lane < block_width && !bed.is_void(block.a(lane)); ++lane) {
    const std::int32_t a = block.a(lane), b = block.b(lane);
    if (a == pair.a || a == pair.b || b == pair.a || b == pair.b) return block_width;
  }
  return lane;
}

template <class Real>
void fill(const SphereBed& bed, std::size_t lane, GrainPair pair, RowBlock<Real>& block) {
  block.set_grains(lane, pair.a, pair.b);
  block.reduced_mass[lane] = reduced_mass<Real>(bed, pair.a, pair.b);
}

/// Makes a row of the pair, in one of the last late blocks or in a new one. Returns false if there
/// is no room.
template <class Real>
bool add_late(const SphereBed& bed, GrainPair pair, SphereContacts<Real>& contacts) {
  constexpr std::size_t open_blocks = 8;
  if (!contacts.layout.subdomains.may_hold(pair)) return false;
  const LateBlocks& late = contacts.late[contacts.layout.subdomains.subdomain_of(pair)];
  BlockRange& range = contacts.shares.ranges[late.range];
  const std::size_t end = range.first + range.blocks;
  for (std::size_t block = end - std::min(open_blocks, end - late.first); block < end; ++block) {
    const std::size_t lane = free_lane(bed, contacts.rows[block], pair);
    if (lane == block_width) continue;
    fill(bed, lane, pair, contacts.rows[block]);
    return true;
  }
  if (end == late.end) return false;
  fill(bed, 0, pair, contacts.rows[end]);
  ++range.blocks;
  return true;
}

/// Makes a row of a grain that has come near a wall, in the last block of the wall's rows in the
/// grain's subdomain. Returns false if there is no room.
template <class Real>
bool add_at_wall(const SphereBed& bed, const WallRows& wall, std::int32_t grain,
                 SphereContacts<Real>& contacts) {
  const std::size_t subdomain = contacts.layout.subdomains.subdomain_of(grain);
  for (const BlockRange& range : contacts.layout.wall_ranges[subdomain]) {
    const std::size_t end = contacts.pair_blocks + range.first + range.blocks;
    if (end <= wall.first || end > wall.first + wall.blocks) continue;
    const std::size_t lane = free_lane(bed, contacts.rows[end - 1], {grain, grain});
    if (lane == block_width) return false;
    for (std::size_t block = end - contacts.blocks_of_row(wall); block < end; ++block) {
      fill(bed, lane, {grain, bed.wall(subdomain)}, contacts.rows[block]);
    }
    return true;
  }
  return false;
}

template <class Real>
bool add_near_walls(const SphereBed& bed, const Candidates& candidates,
                    SphereContacts<Real>& contacts) {
  for (const WallRows& wall : contacts.walls) {
    const std::vector<std::int32_t>& grains = candidates.walls[wall.wall];
    std::size_t& taken = contacts.taken_at_walls[wall.wall];
    for (; taken < grains.size(); ++taken) {
      if (!add_at_wall(bed, wall, grains[taken], contacts)) return false;
    }
  }
  return true;
}

}  // namespace

template <class Real>
double measure_blocks(const SphereBed& bed, const ExecutionContext& context, double correction,
                      RowBlock<Real>* rows, std::size_t blocks, std::vector<double>& sunk) {
  constexpr std::size_t blocks_of_part = 1024;
  const std::size_t parts = blocks / blocks_of_part + 1;
  sunk.assign(parts, 0.0);
  parallel_for(context.loop, parts, [&](std::size_t part) {
    const std::size_t first = part * blocks_of_part;
    sunk[part] = kernels_of<Real>(context.kernels)
                     .rows.sphere_gaps(rows + first, std::min(blocks_of_part, blocks - first),
                                       bed.position.data(), bed.box.period_x(), bed.box.period_y(),
                                       correction);
  });
  return std::max(0.0, *std::max_element(sunk.begin(), sunk.end()));
}

template <class Real>
void part_spares(double reach, const ExecutionContext& context, const SphereBed& bed,
                 const Candidates& candidates, SphereContacts<Real>& contacts) {
  Spares<Real>& spares = contacts.spares;
  std::vector<GrainPair>& near = contacts.layout.near;
  spares.blocks.clear();
  spares.count = 0;
  near.clear();
  for (const GrainPair pair : candidates.pairs) add_spare(bed, pair, spares);
  measure(bed, context, contacts);
  const std::size_t all = std::exchange(spares.count, 0);
  const auto limit = static_cast<Real>(reach + gap_rounding);
  for (std::size_t k = 0; k < all; ++k) {
    const RowBlock<Real>& from = spares.blocks[k / block_width];
    const std::size_t lane = k % block_width;
    const GrainPair pair{from.a(lane), from.b(lane)};
    if (from.gap[lane] < limit && contacts.layout.subdomains.may_hold(pair)) {
      near.push_back(pair);
    } else {
      spares.blocks[spares.count / block_width].set_grains(spares.count % block_width, pair.a,
                                                           pair.b);
      ++spares.count;
    }
  }
  spares.blocks.resize((spares.count + block_width - 1) / block_width);
  for (std::size_t k = spares.count; k < spares.blocks.size() * block_width; ++k) {
    make_void(bed, k % block_width, spares.blocks.back());
  }
  contacts.taken_pairs = candidates.pairs.size();
}

template <class Real>
bool add_near(double near, const ExecutionContext& context, const SphereBed& bed,
              const Candidates& candidates, SphereContacts<Real>& contacts) {
  for (; contacts.taken_pairs < candidates.pairs.size(); ++contacts.taken_pairs) {
    add_spare(bed, candidates.pairs[contacts.taken_pairs], contacts.spares);
  }
  measure(bed, context, contacts);
  bool has_room = add_near_walls(bed, candidates, contacts);
  for (RowBlock<Real>& block : contacts.spares.blocks) {
    visit_near(near, block, [&](std::size_t lane) {
      has_room = has_room && add_late(bed, {block.a(lane), block.b(lane)}, contacts);
      make_void(bed, lane, block);
    });
  }
  return has_room;
}

template double measure_blocks(const SphereBed&, const ExecutionContext&, double, RowBlock<float>*,
                               std::size_t, std::vector<double>&);
template double measure_blocks(const SphereBed&, const ExecutionContext&, double, RowBlock<double>*,
                               std::size_t, std::vector<double>&);
template void part_spares(double, const ExecutionContext&, const SphereBed&, const Candidates&,
                          SphereContacts<float>&);
template void part_spares(double, const ExecutionContext&, const SphereBed&, const Candidates&,
                          SphereContacts<double>&);
template bool add_near(double, const ExecutionContext&, const SphereBed&, const Candidates&,
                       SphereContacts<float>&);
template bool add_near(double, const ExecutionContext&, const SphereBed&, const Candidates&,
                       SphereContacts<double>&);

}  // namespace grainsweep
