#include "engine/rows/contacts.hpp"

#include <algorithm>

#include "engine/rows/block_writer.hpp"

namespace grainsweep {

namespace {

/// Name of the wall that owns `block` in carried impulses.
template <class Real>
std::int32_t wall_name(const SphereBed& bed, const Contacts<Real>& contacts, std::size_t block) {
  std::size_t k = 0;
  while (block >= contacts.walls[k].first + contacts.walls[k].blocks) {
    ++k;
  }
  return static_cast<std::int32_t>(bed.grains() + k);
}

/// Calls visit(a, other, impulse) for each row that pushed: rows of the same grain never at the
/// same time.
template <class Real, class Visit>
void visit_pushing(const SphereBed& bed, const Contacts<Real>& contacts, const ParallelFor& loop,
                   const Visit& visit) {
  visit_ranges(contacts.shares, loop, [&](BlockRange range) {
    for (std::size_t block = range.first; block < range.first + range.blocks; ++block) {
      const bool is_pair = block < contacts.pair_blocks;
      const std::int32_t wall = is_pair ? 0 : wall_name(bed, contacts, block);
      for (std::size_t lane = 0; lane < block_width; ++lane) {
        const Real impulse = contacts.impulse[block * block_width + lane];
        if (impulse > Real(0)) {
          const RowBlock<Real>& r = contacts.rows[block];
          visit(r.a(lane), is_pair ? r.b(lane) : wall, impulse);
        }
      }
    }
  });
}

/// Sorts the impulses that pushed by their first grain.
template <class Real>
void collect_impulses(const SphereBed& bed, const ParallelFor& loop, Contacts<Real>& contacts) {
  auto& begin = contacts.layout.carried_begin;
  begin.assign(bed.grains() + 2, 0);
  visit_pushing(bed, contacts, loop, [&](std::int32_t a, std::int32_t, Real) {
    ++begin[static_cast<std::size_t>(a) + 2];
  });
  for (std::size_t i = 2; i < begin.size(); ++i) {
    begin[i] += begin[i - 1];
  }
  contacts.layout.carried.resize(static_cast<std::size_t>(begin.back()));
  visit_pushing(bed, contacts, loop, [&](std::int32_t a, std::int32_t other, Real impulse) {
    const auto at = static_cast<std::size_t>(begin[static_cast<std::size_t>(a) + 1]++);
    contacts.layout.carried[at] = {other, impulse};
  });
}

/// Impulse that the contact of grain `a` and `other` had; 0 if it did not push.
template <class Real>
Real carried_impulse(const LayoutColumns<Real>& layout, std::int32_t a, std::int32_t other) {
  const auto first = static_cast<std::size_t>(layout.carried_begin[static_cast<std::size_t>(a)]);
  const auto last = static_cast<std::size_t>(layout.carried_begin[static_cast<std::size_t>(a) + 1]);
  for (std::size_t k = first; k < last; ++k) {
    if (layout.carried[k].other == other) {
      return layout.carried[k].impulse;
    }
  }
  return Real(0);
}

/// Rows of one subdomain. Those that push come first, so that whole blocks of the others need no
/// pushing.
template <class Real>
void lay_out_subdomain(const SphereBed& bed, std::size_t subdomain, LayoutColumns<Real>& layout) {
  RowColumns<Real>& columns = layout.columns[subdomain];
  columns.rows.clear();
  columns.impulse.clear();
  BlockWriter<Real> writer(bed, subdomain, columns);
  OpenBlocks open(layout.open_blocks);
  const auto add = [&](GrainPair pair, Real impulse) {
    writer.fill(open.take(pair.a, pair.b, [&] { return writer.append_void_block(); }), pair.a,
                pair.b, impulse);
  };
  const std::size_t first = layout.subdomains.begin[subdomain];
  const std::size_t last = layout.subdomains.begin[subdomain + 1];
  for (std::size_t k = first; k < last; ++k) {
    const GrainPair pair = layout.subdomains.pairs[k];
    layout.pair_impulse[k] = carried_impulse(layout, pair.a, pair.b);
    if (layout.pair_impulse[k] > Real(0)) {
      add(pair, layout.pair_impulse[k]);
    }
  }
  for (std::size_t k = first; k < last; ++k) {
    if (!(layout.pair_impulse[k] > Real(0))) {
      add(layout.subdomains.pairs[k], Real(0));
    }
  }
  open.close_all();
}

/// Sorts the grains near a wall by subdomain.
void divide_near_wall(const std::vector<std::int32_t>& grains, const Subdomains& subdomains,
                      std::vector<std::vector<std::int32_t>>& near_wall) {
  near_wall.resize(std::max(near_wall.size(), subdomains.count));
  for (std::vector<std::int32_t>& of_subdomain : near_wall) of_subdomain.clear();
  for (const std::int32_t grain : grains) {
    near_wall[subdomains.subdomain_of(grain)].push_back(grain);
  }
}

/// Rows of all walls, wall after wall, in blocks of their own for each subdomain.
template <class Real>
void lay_out_walls(const SphereBed& bed, const Candidates& candidates, Contacts<Real>& contacts) {
  LayoutColumns<Real>& layout = contacts.layout;
  RowColumns<Real>& columns = layout.columns[layout.subdomains.count];
  columns.rows.clear();
  columns.impulse.clear();
  contacts.walls.clear();
  layout.wall_ranges.resize(std::max(layout.wall_ranges.size(), layout.subdomains.count));
  for (std::vector<BlockRange>& ranges : layout.wall_ranges) ranges.clear();
  for (std::size_t k = 0; k < candidates.walls.size(); ++k) {
    const std::size_t first = columns.rows.size();
    const auto name = static_cast<std::int32_t>(bed.grains() + k);
    divide_near_wall(candidates.walls[k].grains, layout.subdomains, layout.near_wall);
    for (std::size_t subdomain = 0; subdomain < layout.subdomains.count; ++subdomain) {
      const std::size_t before = columns.rows.size();
      BlockWriter<Real>(bed, subdomain, columns)
          .add_wall(layout.near_wall[subdomain],
                    [&](std::int32_t grain) { return carried_impulse(layout, grain, name); });
      if (columns.rows.size() > before) {
        layout.wall_ranges[subdomain].push_back({before, columns.rows.size() - before});
      }
    }
    contacts.walls.push_back({k, first, columns.rows.size() - first});
  }
}

/// The rows of a subdomain, and the grains of it and the subdomain that follows: in both phases
/// these are all grains, but for those of the first subdomain in the second phase where nothing
/// follows the last one.
template <class Real>
void add_part(std::size_t subdomain, Contacts<Real>& contacts) {
  const LayoutColumns<Real>& layout = contacts.layout;
  RowPart part;
  part.phase = subdomain % 2;
  part.first_range = contacts.shares.ranges.size();
  contacts.shares.ranges.push_back(
      {layout.first_block[subdomain], layout.columns[subdomain].rows.size()});
  for (const BlockRange& range : layout.wall_ranges[subdomain]) {
    contacts.shares.ranges.push_back({contacts.pair_blocks + range.first, range.blocks});
  }
  part.ranges = contacts.shares.ranges.size() - part.first_range;
  if (layout.subdomains.count > 1) {
    const std::vector<std::size_t>& first = layout.subdomains.first_grain;
    const bool is_last = subdomain + 1 == layout.subdomains.count;
    const std::size_t follows = !is_last ? first[subdomain + 2] - first[subdomain + 1]
                                : layout.subdomains.is_ring ? first[1]
                                                            : 0;
    part.first_grain = first[subdomain];
    part.grains = first[subdomain + 1] - first[subdomain] + follows;
  }
  contacts.shares.parts.push_back(part);
}

/// The grains of all subdomains, and once more of the first after the last of a ring; where there
/// is none, a part of no rows for the first ones.
void add_grains(const Subdomains& subdomains, RowShares& shares) {
  shares.grains = subdomains.grains;
  if (subdomains.is_ring) {
    shares.grains.insert(
        shares.grains.end(), subdomains.grains.begin(),
        subdomains.grains.begin() + static_cast<std::ptrdiff_t>(subdomains.first_grain[1]));
  } else {
    shares.parts.push_back({1, 0, 0, 0, subdomains.first_grain[1]});
  }
}

/// Parts that cores may sweep: every second subdomain, then those between.
template <class Real>
void set_parts(Contacts<Real>& contacts) {
  const Subdomains& subdomains = contacts.layout.subdomains;
  contacts.shares.clear();
  contacts.pair_blocks = contacts.layout.first_block[subdomains.count];
  for (WallRows& wall : contacts.walls) wall.first += contacts.pair_blocks;
  for (std::size_t k = 0; k < subdomains.count; k += 2) add_part(k, contacts);
  if (subdomains.count > 1) {
    add_grains(subdomains, contacts.shares);
    for (std::size_t k = 1; k < subdomains.count; k += 2) add_part(k, contacts);
  }
}

/// One column of rows out of those of all subdomains.
template <class Real>
void join(const ParallelFor& loop, Contacts<Real>& contacts) {
  LayoutColumns<Real>& layout = contacts.layout;
  std::size_t blocks = 0;
  layout.first_block.clear();
  for (std::size_t k = 0; k <= layout.subdomains.count; ++k) {
    layout.first_block.push_back(blocks);
    blocks += layout.columns[k].rows.size();
  }
  contacts.rows.resize(blocks);
  contacts.impulse.resize(blocks * block_width);
  parallel_for(loop, layout.subdomains.count + 1, [&](std::size_t k) {
    const RowColumns<Real>& from = layout.columns[k];
    const std::size_t first = layout.first_block[k];
    std::copy(from.rows.begin(), from.rows.end(), contacts.rows.data() + first);
    std::copy(from.impulse.begin(), from.impulse.end(),
              contacts.impulse.data() + first * block_width);
  });
}

/// Normal from the grain to the wall, and gap.
template <class Real>
void detect_wall(const SphereBed& bed, const WallRows& rows, double correction,
                 std::vector<RowBlock<Real>>& blocks) {
  const Wall& wall = bed.walls[rows.wall];
  for (std::size_t block = rows.first; block < rows.first + rows.blocks; ++block) {
    RowBlock<Real>& r = blocks[block];
    for (std::size_t lane = 0; lane < block_width; ++lane) {
      const Record<double>& p = bed.position[static_cast<std::size_t>(r.a(lane))];
      const double gap = bed.is_void(r.a(lane)) ? 1.0 : wall.gap(p);
      const UnitVector inward = wall.normal(p.x, p.y, p.z);
      r.normal_x[lane] = static_cast<Real>(-inward.x);
      r.normal_y[lane] = static_cast<Real>(-inward.y);
      r.normal_z[lane] = static_cast<Real>(-inward.z);
      r.gap[lane] = static_cast<Real>(gap < 0.0 ? correction * gap : gap);
    }
  }
}

}  // namespace

template <class Real>
void lay_out(const SphereBed& bed, const Candidates& candidates, Contacts<Real>& contacts,
             const ParallelFor& loop) {
  LayoutColumns<Real>& layout = contacts.layout;
  collect_impulses(bed, loop, contacts);
  divide(bed, candidates, loop, layout.subdomains);
  layout.columns.resize(std::max(layout.columns.size(), layout.subdomains.count + 1));
  layout.open_blocks.assign(bed.grains(), 0);
  layout.pair_impulse.resize(layout.subdomains.pairs.size());
  visit_subdomains(layout.subdomains.count, loop,
                   [&](std::size_t subdomain) { lay_out_subdomain(bed, subdomain, layout); });
  lay_out_walls(bed, candidates, contacts);
  join(loop, contacts);
  set_parts(contacts);
  contacts.extrapolated.assign(contacts.impulse.size(), Real(0));
}

template <class Real>
double detect(const SphereBed& bed, const ExecutionContext& context, double correction,
              Contacts<Real>& contacts) {
  constexpr std::size_t blocks_of_part = 1024;
  const std::size_t parts = contacts.pair_blocks / blocks_of_part + 1;
  contacts.sunk.assign(parts, 0.0);
  parallel_for(context.loop, parts, [&](std::size_t part) {
    const std::size_t first = part * blocks_of_part;
    contacts.sunk[part] =
        row_kernels<Real>(context.kernels)
            .sphere_gaps(contacts.rows.data() + first,
                         std::min(blocks_of_part, contacts.pair_blocks - first),
                         bed.position.data(), bed.box.period_x(), bed.box.period_y(), correction);
  });
  for (const WallRows& wall : contacts.walls) {
    detect_wall(bed, wall, correction, contacts.rows);
  }
  return std::max(0.0, *std::max_element(contacts.sunk.begin(), contacts.sunk.end()));
}

template void lay_out(const SphereBed&, const Candidates&, Contacts<float>&, const ParallelFor&);
template void lay_out(const SphereBed&, const Candidates&, Contacts<double>&, const ParallelFor&);
template double detect(const SphereBed&, const ExecutionContext&, double, Contacts<float>&);
template double detect(const SphereBed&, const ExecutionContext&, double, Contacts<double>&);

}  // namespace grainsweep
