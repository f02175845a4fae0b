#include "engine/contact/contacts.hpp"

#include <algorithm>

namespace grainsweep {

namespace {

constexpr std::size_t most_open = 64;  // blocks filled at the same time: bits of a word

/// Appends blocks of void rows to `contacts` and hands out their lanes.
template <class Real>
class BlockWriter {
 public:
  BlockWriter(const SphereBed& bed, Contacts<Real>& contacts) : bed_(bed), contacts_(contacts) {
    contacts_.layout.open_blocks.assign(bed.grains(), 0);
    contacts_.rows.clear();
    contacts_.impulse.clear();
  }

  /// Puts a pair into the first open block that holds neither of its grains, so that neighbours in
  /// space stay neighbours in memory.
  void add_pair(GrainPair pair, Real impulse) {
    auto& in_blocks = contacts_.layout.open_blocks;
    std::uint64_t& a = in_blocks[static_cast<std::size_t>(pair.a)];
    std::uint64_t& b = in_blocks[static_cast<std::size_t>(pair.b)];
    if ((a | b) == ~std::uint64_t{0}) {
      close(fullest());
    }
    const auto slot = static_cast<std::size_t>(__builtin_ctzll(~(a | b)));
    a |= std::uint64_t{1} << slot;
    b |= std::uint64_t{1} << slot;
    open(slot);
    fill_lane(block_[slot], used_[slot]++, pair.a, pair.b, impulse);
    if (used_[slot] == block_width) {
      close(slot);
    }
  }

  /// Closes all pair blocks; what follows belongs to walls.
  void finish_pairs() {
    for (std::size_t slot = 0; slot < most_open; ++slot) {
      if (used_[slot] > 0) {
        close(slot);
      }
    }
    contacts_.pair_blocks = contacts_.rows.size();
  }

  /// Rows of one wall: no grain touches it twice, so lanes are filled in order.
  template <class ImpulseOf>
  void add_wall(const WallCandidates& near, ImpulseOf impulse_of) {
    contacts_.walls.push_back({near.wall, contacts_.rows.size(), 0});
    for (std::size_t k = 0; k < near.grains.size(); ++k) {
      if (k % block_width == 0) {
        append_void_block();
      }
      fill_lane(contacts_.rows.size() - 1, k % block_width, near.grains[k], bed_.wall(),
                impulse_of(near.grains[k]));
    }
    contacts_.walls.back().blocks = contacts_.rows.size() - contacts_.walls.back().first;
  }

 private:
  void open(std::size_t slot) {
    if (used_[slot] == 0) {
      block_[slot] = contacts_.rows.size();
      append_void_block();
    }
  }
  void append_void_block() {
    contacts_.rows.emplace_back();
    RowBlock<Real>& block = contacts_.rows.back();
    for (std::size_t lane = 0; lane < block_width; ++lane) {
      block.set_grains(lane, bed_.void_a(), bed_.void_b());
    }
    std::fill(std::begin(block.reduced_mass), std::end(block.reduced_mass), Real(1));
    contacts_.impulse.resize(contacts_.rows.size() * block_width, Real(0));
  }
  void fill_lane(std::size_t block, std::size_t lane, std::int32_t a, std::int32_t b,
                 Real impulse) {
    contacts_.rows[block].set_grains(lane, a, b);
    contacts_.rows[block].reduced_mass[lane] = reduced_mass(a, b);
    contacts_.impulse[block * block_width + lane] = impulse;
  }
  Real reduced_mass(std::int32_t a, std::int32_t b) const {
    return static_cast<Real>(1.0 / (bed_.motion[static_cast<std::size_t>(a)].w +
                                    bed_.motion[static_cast<std::size_t>(b)].w));
  }
  /// Makes room for a new block: the grains of the closed one forget it.
  void close(std::size_t slot) {
    const RowBlock<Real>& block = contacts_.rows[block_[slot]];
    const std::uint64_t keep = ~(std::uint64_t{1} << slot);
    for (std::size_t lane = 0; lane < used_[slot]; ++lane) {
      contacts_.layout.open_blocks[static_cast<std::size_t>(block.a(lane))] &= keep;
      contacts_.layout.open_blocks[static_cast<std::size_t>(block.b(lane))] &= keep;
    }
    used_[slot] = 0;
  }
  std::size_t fullest() const {
    return static_cast<std::size_t>(std::max_element(used_, used_ + most_open) - used_);
  }

  const SphereBed& bed_;
  Contacts<Real>& contacts_;
  std::size_t block_[most_open] = {};
  std::size_t used_[most_open] = {};
};

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

/// Rows that push come first, so that whole blocks of the others need no pushing.
template <class Real>
void add_pairs(const Candidates& candidates, LayoutColumns<Real>& layout,
               BlockWriter<Real>& writer) {
  layout.pair_impulse.clear();
  for (const GrainPair pair : candidates.pairs) {
    const Real impulse = carried_impulse(layout, pair.a, pair.b);
    layout.pair_impulse.push_back(impulse);
    if (impulse > Real(0)) {
      writer.add_pair(pair, impulse);
    }
  }
  for (std::size_t k = 0; k < candidates.pairs.size(); ++k) {
    if (!(layout.pair_impulse[k] > Real(0))) {
      writer.add_pair(candidates.pairs[k], Real(0));
    }
  }
  writer.finish_pairs();
}

/// Normal from the grain to the wall, and gap.
template <class Real>
void detect_wall(const SphereBed& bed, const WallRows& rows, double correction,
                 std::vector<RowBlock<Real>>& blocks) {
  const auto toward = static_cast<Real>(-rows.wall.sign);
  for (std::size_t block = rows.first; block < rows.first + rows.blocks; ++block) {
    RowBlock<Real>& r = blocks[block];
    for (std::size_t lane = 0; lane < block_width; ++lane) {
      const bool is_void = r.a(lane) == bed.void_a();
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
void lay_out(const SphereBed& bed, const Candidates& candidates, Contacts<Real>& contacts) {
  collect_impulses(bed, contacts);
  contacts.walls.clear();
  BlockWriter<Real> writer(bed, contacts);
  add_pairs(candidates, contacts.layout, writer);
  for (std::size_t k = 0; k < candidates.walls.size(); ++k) {
    const auto name = static_cast<std::int32_t>(bed.grains() + k);
    writer.add_wall(candidates.walls[k], [&](std::int32_t grain) {
      return carried_impulse(contacts.layout, grain, name);
    });
  }
  contacts.extrapolated.assign(contacts.impulse.size(), Real(0));
}

template <class Real>
void detect(const SphereBed& bed, const Kernels& kernels, double correction,
            Contacts<Real>& contacts) {
  row_kernels<Real>(kernels).sphere_gaps(contacts.rows.data(), contacts.pair_blocks,
                                         bed.position.data(), bed.box.period_x(),
                                         bed.box.period_y(), correction);
  for (const WallRows& wall : contacts.walls) {
    detect_wall(bed, wall, correction, contacts.rows);
  }
}

template void lay_out(const SphereBed&, const Candidates&, Contacts<float>&);
template void lay_out(const SphereBed&, const Candidates&, Contacts<double>&);
template void detect(const SphereBed&, const Kernels&, double, Contacts<float>&);
template void detect(const SphereBed&, const Kernels&, double, Contacts<double>&);

}  // namespace grainsweep
