#include "engine/rows/sphere_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/rows/block_writer.hpp"
#include "engine/rows/late_rows.hpp"

namespace grainsweep {

namespace {

/// Stands for the first block of a round wall where there is none.
constexpr std::size_t open_ended = std::numeric_limits<std::size_t>::max();

/// Name of the wall that owns `block` in carried impulses; its second row has the next one.
template <class Real>
std::int32_t wall_name(const SphereBed& bed, const SphereContacts<Real>& contacts,
                       std::size_t block) {
  std::size_t k = 0;
  while (block >= contacts.walls[k].first + contacts.walls[k].blocks) {
    ++k;
  }
  const std::size_t row = block < contacts.first_round ? 0 : (block - contacts.first_round) % 2;
  return bed.wall_name(k + row);
}

/// The second side of a row's contact in carried impulses.
template <class Real>
std::int32_t other_side(const SphereBed& bed, const SphereContacts<Real>& contacts,
                        std::size_t block, std::size_t lane) {
  return block < contacts.pair_blocks ? contacts.rows[block].b(lane)
                                      : wall_name(bed, contacts, block);
}

/// std::hypot is rounded in other ways by other libraries.
template <class Real>
Real length_of(Real x, Real y) {
  return std::sqrt(x * x + y * y);
}

/// Calls visit(block, lane, impulse) for each contact that bore a force; for a round wall with the
/// first of its two blocks.
template <class Real, class Visit>
void visit_force_bearing(const SphereContacts<Real>& contacts, double dt, Visit visit) {
  const double least = least_force * dt * dt;
  const std::size_t round = contacts.first_round * block_width;
  for (std::size_t at = 0; at < round; ++at) {
    const auto impulse = static_cast<double>(contacts.impulse[at]);
    if (impulse > least) visit(at / block_width, at % block_width, impulse);
  }
  for (std::size_t at = round; at < contacts.impulse.size(); ++at) {
    if (at / block_width % 2 != contacts.first_round % 2) continue;
    const double impulse = length_of(static_cast<double>(contacts.impulse[at]),
                                     static_cast<double>(contacts.impulse[at + block_width]));
    if (impulse > least) visit(at / block_width, at % block_width, impulse);
  }
}
/// What `to` takes over from the contacts `from`: their impulses times `factor`.
template <class From, class To>
void collect_impulses(const SphereBed& bed, const ParallelFor& loop, double factor,
                      const SphereContacts<From>& from, SphereContacts<To>& to) {
  const auto visit_all = [&](const auto& put) {
    visit_lanes(from, loop, [&](std::size_t block, std::size_t lane, std::size_t at) {
      if (from.impulse[at] == From(0)) return;
      put(from.rows[block].a(lane),
          CarriedImpulse<To>{other_side(bed, from, block, lane),
                             static_cast<To>(factor * static_cast<double>(from.impulse[at]))});
    });
  };
  collect(bed.grains(), visit_all, to.layout.carried);
}

/// Impulse that the contact of grain `a` and `other` had; 0 if it did not push.
template <class Real>
Real carried_impulse(const LayoutColumns<Real>& layout, std::int32_t a, std::int32_t other) {
  for (const CarriedImpulse<Real>& entry : layout.carried.of(a)) {
    if (entry.other == other) return entry.impulse;
  }
  return Real(0);
}

/// Rows of one subdomain, and void blocks for late rows, in proportion. Rows that push come first,
/// so that whole blocks of the others need no pushing.
template <class Real>
void lay_out_subdomain(const SphereBed& bed, std::size_t subdomain, double late_share,
                       SphereContacts<Real>& contacts) {
  LayoutColumns<Real>& layout = contacts.layout;
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
  const std::size_t filled = columns.rows.size();
  const auto end =
      static_cast<std::size_t>(std::ceil((1.0 + late_share) * static_cast<double>(filled)));
  while (columns.rows.size() < end) writer.append_void_block();
  contacts.late[subdomain] = {0, filled, end};
}

/// How a layout takes round walls.
enum class RoundWalls { as_they_are, as_tangents };

/// Rows of wall k in a subdomain, with the impulses that they carry.
template <class Real>
void add_wall(const SphereBed& bed, std::size_t k, std::size_t subdomain, RoundWalls round,
              RowColumns<Real>& columns, const LayoutColumns<Real>& layout) {
  const std::vector<std::int32_t>& grains = layout.subdomains.near_wall(k, subdomain);
  const auto impulse = [&](std::int32_t grain, std::size_t row) {
    return carried_impulse(layout, grain, bed.wall_name(k + row));
  };
  BlockWriter<Real> writer(bed, subdomain, columns);
  if (!bed.walls[k].is_round()) {
    writer.add_flat_wall(grains, [&](std::int32_t grain) { return impulse(grain, 0); });
  } else if (round == RoundWalls::as_they_are) {
    writer.add_round_wall(grains, impulse);
  } else {
    writer.add_flat_wall(grains, [&](std::int32_t grain) {
      return length_of(impulse(grain, 0), impulse(grain, 1));
    });
  }
}

/// Rows of all walls, wall after wall, in blocks of their own for each subdomain.
template <class Real>
void lay_out_walls(const SphereBed& bed, const Candidates& candidates, RoundWalls round,
                   SphereContacts<Real>& contacts) {
  LayoutColumns<Real>& layout = contacts.layout;
  RowColumns<Real>& columns = layout.columns[layout.subdomains.count];
  columns.rows.clear();
  columns.impulse.clear();
  contacts.walls.clear();
  contacts.first_round = open_ended;
  layout.wall_ranges.resize(std::max(layout.wall_ranges.size(), layout.subdomains.count));
  for (std::vector<BlockRange>& ranges : layout.wall_ranges) ranges.clear();
  for (std::size_t k = 0; k < candidates.walls.size(); ++k) {
    const std::size_t first = columns.rows.size();
    for (std::size_t subdomain = 0; subdomain < layout.subdomains.count; ++subdomain) {
      const std::size_t before = columns.rows.size();
      add_wall(bed, k, subdomain, round, columns, layout);
      if (columns.rows.size() > before) {
        layout.wall_ranges[subdomain].push_back({before, columns.rows.size() - before});
      }
    }
    contacts.walls.push_back({k, first, columns.rows.size() - first});
    if (bed.walls[k].is_round() && round == RoundWalls::as_they_are) contacts.first_round = first;
  }
}

/// Parts that cores may sweep: the rows of a subdomain's pairs and of its walls.
template <class Real>
void set_parts(SphereContacts<Real>& contacts) {
  const LayoutColumns<Real>& layout = contacts.layout;
  contacts.pair_blocks = layout.first_block[layout.subdomains.count];
  for (WallRows& wall : contacts.walls) wall.first += contacts.pair_blocks;
  contacts.first_round = contacts.first_round == open_ended
                             ? contacts.rows.size()
                             : contacts.first_round + contacts.pair_blocks;
  share_out(layout.subdomains, contacts.shares, [&](std::size_t subdomain, auto& ranges) {
    LateBlocks& late = contacts.late[subdomain];
    const std::size_t first = layout.first_block[subdomain];
    late = {ranges.size(), first + late.first, first + late.end};
    ranges.push_back({first, late.first - first});
    for (const BlockRange& range : layout.wall_ranges[subdomain]) {
      ranges.push_back({contacts.pair_blocks + range.first, range.blocks});
    }
  });
}

/// One column of rows out of those of all subdomains.
template <class Real>
void join(const ParallelFor& loop, SphereContacts<Real>& contacts) {
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

/// The gap that a step is given, if it repairs a share `correction` of an overlap.
double corrected(double gap, double correction) { return gap < 0.0 ? correction * gap : gap; }

/// Normal from the grain to the wall, and gap; for a round wall those of its tangent plane.
template <class Real>
void update_flat_wall(const SphereBed& bed, const WallRows& rows, double correction,
                      std::vector<RowBlock<Real>>& blocks) {
  const Wall& wall = bed.walls[rows.wall];
  for (std::size_t block = rows.first; block < rows.first + rows.blocks; ++block) {
    RowBlock<Real>& r = blocks[block];
    for (std::size_t lane = 0; lane < block_width; ++lane) {
      const Record<double>& p = bed.position[static_cast<std::size_t>(r.a(lane))];
      const UnitVector inward = wall.normal(p.x, p.y, p.z);
      const double gap = bed.is_void(r.a(lane)) ? 1.0 : wall.gap(p);
      r.normal_x[lane] = static_cast<Real>(-inward.x);
      r.normal_y[lane] = static_cast<Real>(-inward.y);
      r.normal_z[lane] = static_cast<Real>(-inward.z);
      r.gap[lane] = static_cast<Real>(corrected(gap, correction));
    }
  }
}

/// Place of the centre from the axis, and |place|^2 less the squared radius of the circle that it
/// may not leave: as far from the axis as its gap allows.
template <class Real>
void update_round_wall(const SphereBed& bed, const WallRows& rows, double correction,
                       std::vector<RowBlock<Real>>& blocks) {
  const Wall& wall = bed.walls[rows.wall];
  for (std::size_t block = rows.first; block < rows.first + rows.blocks; block += 2) {
    RowBlock<Real>&along_x = blocks[block], &along_y = blocks[block + 1];
    for (std::size_t lane = 0; lane < block_width; ++lane) {
      const bool is_void = bed.is_void(along_x.a(lane));
      const Record<double>& p = bed.position[static_cast<std::size_t>(along_x.a(lane))];
      const double x = is_void ? 0.0 : p.x - wall.radius, y = is_void ? 0.0 : p.y - wall.radius;
      const double gap = is_void ? 1.0 : corrected(wall.gap(p), correction);
      along_x.gap[lane] = static_cast<Real>(x);
      along_y.gap[lane] = static_cast<Real>(y);
      along_y.reduced_mass[lane] = static_cast<Real>(-gap * (2.0 * std::sqrt(x * x + y * y) + gap));
    }
  }
}

/// Rows of some pairs and of all walls, with the impulses that they carry; the grains must have
/// been divided.
template <class Real>
void lay_out_carried(const SphereBed& bed, const Candidates& candidates,
                     const std::vector<GrainPair>& pairs, double late_share,
                     const ParallelFor& loop, SphereContacts<Real>& contacts,
                     RoundWalls round = RoundWalls::as_they_are) {
  LayoutColumns<Real>& layout = contacts.layout;
  divide_pairs(pairs, loop, layout.subdomains);
  layout.columns.resize(std::max(layout.columns.size(), layout.subdomains.count + 1));
  layout.open_blocks.assign(bed.grains(), 0);
  layout.pair_impulse.resize(layout.subdomains.pairs.size());
  contacts.late.resize(layout.subdomains.count);
  visit_subdomains(layout.subdomains.count, loop, [&](std::size_t subdomain) {
    lay_out_subdomain(bed, subdomain, late_share, contacts);
  });
  lay_out_walls(bed, candidates, round, contacts);
  join(loop, contacts);
  set_parts(contacts);
}

/// Rows of the pairs with a gap below `reach` and of all candidates at walls; the other pairs are
/// spares.
template <class Real>
void lay_out_near(double reach, const ExecutionContext& context, const SphereBed& bed,
                  const Candidates& candidates, SphereContacts<Real>& contacts) {
  constexpr double late_share = 1.0 / 16.0;
  collect_impulses(bed, context.loop, 1.0, contacts, contacts);
  divide_grains(bed, Sphere::subdomain_grains, candidates, context.loop,
                contacts.layout.subdomains);
  part_spares(reach, context, bed, candidates, contacts);
  lay_out_carried(bed, candidates, contacts.layout.near, late_share, context.loop, contacts);
  contacts.taken_at_walls.clear();
  for (const std::vector<std::int32_t>& near : candidates.walls) {
    contacts.taken_at_walls.push_back(near.size());
  }
}

}  // namespace

template <class Real>
void lay_out(const SphereBed& bed, const Candidates& candidates, SphereContacts<Real>& contacts,
             const ParallelFor& loop) {
  collect_impulses(bed, loop, 1.0, contacts, contacts);
  divide_grains(bed, Sphere::subdomain_grains, candidates, loop, contacts.layout.subdomains);
  lay_out_carried(bed, candidates, candidates.pairs, 0.0, loop, contacts);
}

template <class Real>
bool renew_rows(double near, double reach, const ExecutionContext& context, SphereBed& bed,
                Candidates& candidates, SphereContacts<Real>& contacts) {
  constexpr double candidate_margin = 0.09;  // d; near enough for the shortest periodic sides
  const bool is_new = complete_candidates(near, candidate_margin, context, bed, candidates);
  if (is_new || !add_near(near, context, bed, candidates, contacts)) {
    lay_out_near(reach, context, bed, candidates, contacts);
  }
  return is_new;
}

template <class Real>
void lay_out_closed(double tolerance, const ExecutionContext& context, const SphereBed& bed,
                    const Candidates& candidates, double dt, const SphereContacts<Real>& from,
                    SphereContacts<double>& closed) {
  collect_impulses(bed, context.loop, 1.0 / (dt * dt), from, closed);
  divide_grains(bed, Sphere::subdomain_grains, candidates, context.loop, closed.layout.subdomains);
  lay_out_carried(bed, candidates, candidates.pairs, 0.0, context.loop, closed,
                  RoundWalls::as_tangents);
  update_gaps(bed, context, 1.0, closed);
  for (RowBlock<double>& row : closed.rows) {
    for (double& gap : row.gap) gap = gap < tolerance ? 0.0 : open_gap;
  }
}

template <class Real>
double update_gaps(const SphereBed& bed, const ExecutionContext& context, double correction,
                   SphereContacts<Real>& contacts) {
  const double sunk = measure_blocks(bed, context, correction, contacts.rows.data(),
                                     contacts.pair_blocks, contacts.sunk);
  for (const WallRows& wall : contacts.walls) {
    (wall.first < contacts.first_round
         ? update_flat_wall<Real>
         : update_round_wall<Real>)(bed, wall, correction, contacts.rows);
  }
  return sunk;
}

template <class Real>
std::vector<ForceContact> force_contacts(const SphereBed& bed, double dt,
                                         const SphereContacts<Real>& contacts) {
  std::vector<ForceContact> all;
  visit_force_bearing(contacts, dt, [&](std::size_t block, std::size_t lane, double impulse) {
    all.push_back({contacts.rows[block].a(lane), other_side(bed, contacts, block, lane),
                   impulse / (dt * dt)});
  });
  return all;
}

template <class Real>
std::vector<Closure> closures(SphereBed& bed, const ExecutionContext& context, double dt,
                              Candidates& /*candidates*/, SphereContacts<Real>& contacts) {
  update_gaps(bed, context, 1.0, contacts);
  std::vector<Closure> all;
  visit_force_bearing(contacts, dt, [&](std::size_t block, std::size_t lane, double) {
    const bool is_round = block >= contacts.first_round;
    const std::int32_t grain = contacts.rows[block].a(lane);
    const double gap = is_round
                           ? bed.walls.back().gap(bed.position[static_cast<std::size_t>(grain)])
                           : static_cast<double>(contacts.rows[block].gap[lane]);
    const int closed = gap < closed_gap ? 1 : 0;
    all.push_back({gap, closed, is_round ? closed : 0});
  });
  return all;
}

template void lay_out(const SphereBed&, const Candidates&, SphereContacts<float>&,
                      const ParallelFor&);
template void lay_out(const SphereBed&, const Candidates&, SphereContacts<double>&,
                      const ParallelFor&);
template bool renew_rows(double, double, const ExecutionContext&, SphereBed&, Candidates&,
                         SphereContacts<float>&);
template bool renew_rows(double, double, const ExecutionContext&, SphereBed&, Candidates&,
                         SphereContacts<double>&);
template void lay_out_closed(double, const ExecutionContext&, const SphereBed&, const Candidates&,
                             double, const SphereContacts<float>&, SphereContacts<double>&);
template void lay_out_closed(double, const ExecutionContext&, const SphereBed&, const Candidates&,
                             double, const SphereContacts<double>&, SphereContacts<double>&);
template double update_gaps(const SphereBed&, const ExecutionContext&, double,
                            SphereContacts<float>&);
template double update_gaps(const SphereBed&, const ExecutionContext&, double,
                            SphereContacts<double>&);
template std::vector<ForceContact> force_contacts(const SphereBed&, double,
                                                  const SphereContacts<float>&);
template std::vector<ForceContact> force_contacts(const SphereBed&, double,
                                                  const SphereContacts<double>&);
template std::vector<Closure> closures(SphereBed&, const ExecutionContext&, double, Candidates&,
                                       SphereContacts<float>&);
template std::vector<Closure> closures(SphereBed&, const ExecutionContext&, double, Candidates&,
                                       SphereContacts<double>&);

}  // namespace grainsweep
