#include "engine/contact/contacts.hpp"

#include <algorithm>

#include "engine/contact/block_writer.hpp"

namespace grainsweep {

namespace {

/// Number of the wall that owns `block`.
template <class Real>
std::size_t wall_number(const Contacts<Real>& contacts, std::size_t block) {
  std::size_t k = 0;
  while (block >= contacts.walls[k].first + contacts.walls[k].blocks) {
    ++k;
  }
  return k;
}

/// Calls visit(a, other, impulse) for each row that pushed.
template <class Real, class Visit>
void visit_pushing(const SphereBed& bed, const Contacts<Real>& contacts, Visit visit) {
  for (std::size_t block = 0; block < contacts.rows.size(); ++block) {
    const bool is_pair = block < contacts.pair_blocks;
    const auto wall =
        is_pair ? 0 : static_cast<std::int32_t>(bed.grains() + wall_number(contacts, block));
    for (std::size_t lane = 0; lane < block_width; ++lane) {
      const Real impulse = contacts.impulse[block * block_width + lane];
      if (impulse > Real(0)) {
        const RowBlock<Real>& r = contacts.rows[block];
        visit(r.a(lane), is_pair ? r.b(lane) : wall, impulse);
      }
    }
  }
}

/// Sorts the impulses that pushed by their first grain.
template <class Real>
void collect_impulses(const SphereBed& bed, Contacts<Real>& contacts) {
  auto& begin = contacts.layout.carried_begin;
  begin.assign(bed.grains() + 2, 0);
  std::size_t count = 0;
  visit_pushing(bed, contacts, [&](std::int32_t a, std::int32_t, Real) {
    ++begin[static_cast<std::size_t>(a) + 2];
    ++count;
  });
  for (std::size_t i = 2; i < begin.size(); ++i) {
    begin[i] += begin[i - 1];
  }
  contacts.layout.carried.resize(count);
  visit_pushing(bed, contacts, [&](std::int32_t a, std::int32_t other, Real impulse) {
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

/// Rows of one section. Those that push come first, so that whole blocks of the others need no
/// pushing.
template <class Real>
void lay_out_section(const SphereBed& bed, std::size_t section, LayoutColumns<Real>& layout) {
  RowColumns<Real>& columns = layout.columns[section];
  columns.rows.clear();
  columns.impulse.clear();
  BlockWriter<Real> writer(bed, section, layout.open_blocks, columns);
  const std::size_t first = layout.sections.begin[section];
  const std::size_t last = layout.sections.begin[section + 1];
  for (std::size_t k = first; k < last; ++k) {
    const GrainPair pair = layout.sections.pairs[k];
    layout.pair_impulse[k] = carried_impulse(layout, pair.a, pair.b);
    if (layout.pair_impulse[k] > Real(0)) {
      writer.add_pair(pair, layout.pair_impulse[k]);
    }
  }
  for (std::size_t k = first; k < last; ++k) {
    if (!(layout.pair_impulse[k] > Real(0))) {
      writer.add_pair(layout.sections.pairs[k], Real(0));
    }
  }
  writer.finish_pairs();
}

/// Rows of all walls, as one more section.
template <class Real>
void lay_out_walls(const SphereBed& bed, const Candidates& candidates, Contacts<Real>& contacts) {
  RowColumns<Real>& columns = contacts.layout.columns[contacts.layout.sections.count];
  columns.rows.clear();
  columns.impulse.clear();
  contacts.walls.clear();
  BlockWriter<Real> writer(bed, 0, contacts.layout.open_blocks, columns);
  for (std::size_t k = 0; k < candidates.walls.size(); ++k) {
    const std::size_t first = columns.rows.size();
    const auto name = static_cast<std::int32_t>(bed.grains() + k);
    writer.add_wall(candidates.walls[k].grains, [&](std::int32_t grain) {
      return carried_impulse(contacts.layout, grain, name);
    });
    contacts.walls.push_back({candidates.walls[k].wall, first, columns.rows.size() - first});
  }
}

/// Ranges of blocks that cores may sweep: the sections in two phases, then the walls, which all
/// push one record. A single section and the walls are one range.
template <class Real>
void set_ranges(Contacts<Real>& contacts) {
  const LayoutColumns<Real>& layout = contacts.layout;
  const std::size_t sections = layout.sections.count;
  contacts.ranges.clear();
  std::size_t first = 0;
  for (std::size_t k = 0; k <= sections; ++k) {
    const std::size_t blocks = layout.columns[k].rows.size();
    contacts.ranges.push_back({first, blocks, k < sections ? k % 2 : 2});
    first += blocks;
  }
  contacts.pair_blocks = contacts.ranges.back().first;
  for (WallRows& wall : contacts.walls) {
    wall.first += contacts.pair_blocks;
  }
  if (sections == 1) {
    contacts.ranges.assign({{0, first, 0}});
  }
  std::sort(contacts.ranges.begin(), contacts.ranges.end(),
            [](const BlockRange& a, const BlockRange& b) {
              return std::pair(a.phase, a.first) < std::pair(b.phase, b.first);
            });
}

/// One column of rows out of those of all sections.
template <class Real>
void join(const PartLoop& loop, Contacts<Real>& contacts) {
  LayoutColumns<Real>& layout = contacts.layout;
  std::size_t blocks = 0;
  layout.first_block.clear();
  for (std::size_t k = 0; k <= layout.sections.count; ++k) {
    layout.first_block.push_back(blocks);
    blocks += layout.columns[k].rows.size();
  }
  contacts.rows.resize(blocks);
  contacts.impulse.resize(blocks * block_width);
  run_parts(loop, layout.sections.count + 1, [&](std::size_t k) {
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
  const auto toward = static_cast<Real>(-rows.wall.sign);
  for (std::size_t block = rows.first; block < rows.first + rows.blocks; ++block) {
    RowBlock<Real>& r = blocks[block];
    for (std::size_t lane = 0; lane < block_width; ++lane) {
      const bool is_void = bed.is_void(r.a(lane));
      const double gap =
          is_void ? 1.0 : rows.wall.gap(bed.position[static_cast<std::size_t>(r.a(lane))]);
      r.normal_x[lane] = rows.wall.axis == 0 ? toward : Real(0);
      r.normal_y[lane] = rows.wall.axis == 1 ? toward : Real(0);
      r.normal_z[lane] = rows.wall.axis == 2 ? toward : Real(0);
      r.gap[lane] = static_cast<Real>(gap < 0.0 ? correction * gap : gap);
    }
  }
}

}  // namespace

template <class Real>
void lay_out(const SphereBed& bed, const Candidates& candidates, Contacts<Real>& contacts,
             const PartLoop& loop) {
  LayoutColumns<Real>& layout = contacts.layout;
  collect_impulses(bed, contacts);
  divide(candidates, layout.sections);
  layout.columns.resize(std::max(layout.columns.size(), layout.sections.count + 1));
  layout.open_blocks.assign(bed.grains(), 0);
  layout.pair_impulse.resize(layout.sections.pairs.size());
  visit_sections(layout.sections.count, loop,
                 [&](std::size_t section) { lay_out_section(bed, section, layout); });
  lay_out_walls(bed, candidates, contacts);
  set_ranges(contacts);
  join(loop, contacts);
  contacts.extrapolated.assign(contacts.impulse.size(), Real(0));
}

template <class Real>
double detect(const SphereBed& bed, const Processor& processor, double correction,
              Contacts<Real>& contacts) {
  constexpr std::size_t blocks_of_part = 1024;
  const std::size_t parts = contacts.pair_blocks / blocks_of_part + 1;
  contacts.sunk.assign(parts, 0.0);
  run_parts(processor.loop, parts, [&](std::size_t part) {
    const std::size_t first = part * blocks_of_part;
    contacts.sunk[part] =
        row_kernels<Real>(processor.kernels)
            .sphere_gaps(contacts.rows.data() + first,
                         std::min(blocks_of_part, contacts.pair_blocks - first),
                         bed.position.data(), bed.box.period_x(), bed.box.period_y(), correction);
  });
  for (const WallRows& wall : contacts.walls) {
    detect_wall(bed, wall, correction, contacts.rows);
  }
  return std::max(0.0, *std::max_element(contacts.sunk.begin(), contacts.sunk.end()));
}

template void lay_out(const SphereBed&, const Candidates&, Contacts<float>&, const PartLoop&);
template void lay_out(const SphereBed&, const Candidates&, Contacts<double>&, const PartLoop&);
template double detect(const SphereBed&, const Processor&, double, Contacts<float>&);
template double detect(const SphereBed&, const Processor&, double, Contacts<double>&);

}  // namespace grainsweep
