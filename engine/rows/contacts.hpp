// Contacts: the rows that the solver works on, and the impulses they carry from step to step.
//
// Rows persist while their candidates do. They are laid out once, in blocks whose lanes never share
// a grain, and then only their gaps and normals are measured anew in each step. Each wall has
// blocks of its own after those of the pairs.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/broad/candidates.hpp"
#include "engine/context.hpp"
#include "engine/rows/partition.hpp"
#include "engine/rows/subdomains.hpp"
#include "engine/scene/bed.hpp"
#include "kernels/kernels.hpp"

namespace grainsweep {

/// Blocks that belong to one wall: `first` .. `first + blocks`.
struct WallRows {
  std::size_t wall = 0;  ///< of the bed's walls
  std::size_t first = 0;
  std::size_t blocks = 0;
};

/// An impulse of a contact that pushed, under the name of its two sides.
template <class Real>
struct CarriedImpulse {
  std::int32_t other;  ///< the second grain, or grains + k for wall k
  Real impulse;
};

/// Rows and what they carry, impulse k of block b at b * block_width + k.
template <class Real>
struct RowColumns {
  std::vector<RowBlock<Real>> rows;
  std::vector<Real> impulse;
};

/// Memory of the layout of rows, kept from one layout to the next.
template <class Real>
struct LayoutColumns {
  Subdomains subdomains;
  std::vector<RowColumns<Real>> columns;             ///< of each subdomain, then of the walls
  std::vector<std::vector<BlockRange>> wall_ranges;  ///< of each subdomain in the rows of the walls
  std::vector<std::vector<std::int32_t>> near_wall;  ///< grains of each subdomain near one wall
  std::vector<std::size_t> first_block;              ///< of each subdomain in the rows of all
  std::vector<std::uint64_t> open_blocks;  ///< per grain: one bit for each open block it is in
  std::vector<std::int32_t> carried_begin;
  std::vector<CarriedImpulse<Real>> carried;
  std::vector<Real> pair_impulse;  ///< what each candidate pair carries
};

/// Rows and impulses; the impulse of lane k of block b is `impulse[b * block_width + k]`, in masses
/// times d: the force it stands for is impulse / dt^2, in m g.
template <class Real>
struct Contacts {
  std::vector<RowBlock<Real>> rows;
  std::size_t pair_blocks = 0;
  std::vector<WallRows> walls;
  RowShares shares;
  std::vector<Real> impulse;
  std::vector<Real> extrapolated;  ///< the solver's look-ahead impulses
  std::vector<double> sunk;        ///< of each part of a detection: see `detect`
  LayoutColumns<Real> layout;

  // What sweeps over a range need: their kernels, its rows, the first of its impulses.
  static const RowKernels<Real>& kernels_of(const Kernels& all) { return row_kernels<Real>(all); }
  const RowBlock<Real>* rows_of(BlockRange range) const { return rows.data() + range.first; }
  static std::size_t first_impulse(BlockRange range) { return range.first * block_width; }
};

/// Lays the candidates out as rows; contacts that were there before keep their impulse.
template <class Real>
void lay_out(const SphereBed& bed, const Candidates& candidates, Contacts<Real>& contacts,
             const ParallelFor& loop = serial_for);

/// Measures normal and gap of every row. `correction`: share of an overlap that a step repairs.
/// Returns the most by which centres are nearer than sunk_share of the distance at which their
/// grains touch, d; 0 if none are.
template <class Real>
double detect(const SphereBed& bed, const ExecutionContext& context, double correction,
              Contacts<Real>& contacts);

/// Calls visit(row block, lane, impulse) for each row that stands for a pair or a wall.
template <class Real, class Visit>
void visit_rows(const SphereBed& bed, const Contacts<Real>& contacts, Visit visit) {
  for (std::size_t block = 0; block < contacts.rows.size(); ++block) {
    for (std::size_t lane = 0; lane < block_width; ++lane) {
      if (!bed.is_void(contacts.rows[block].a(lane))) {
        visit(contacts.rows[block], lane, contacts.impulse[block * block_width + lane]);
      }
    }
  }
}

}  // namespace grainsweep
