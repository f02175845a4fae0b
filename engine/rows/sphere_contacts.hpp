// Contacts of spheres: rows that persist from step to step.
//
// They are laid out once, in blocks whose lanes never share a grain, and then only their gaps and
// normals are measured anew in each step. Candidates that are too far apart to be rows are spares;
// one that comes near becomes a late row, in blocks that each subdomain keeps free behind its
// others:
//
//     | pairs of subdomain 0 | late, free | pairs of 1 | late, free | ... | wall 0 | wall 1 | ...
//
// Once these are used up all rows are laid out anew. Each wall has blocks of its own; those of a
// round one come last, and two of them that follow one another hold a contact's two rows
// (kernels/row_kernels.hpp).
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "engine/broad/candidates.hpp"
#include "engine/context.hpp"
#include "engine/rows/contacts.hpp"
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

/// Blocks of a subdomain that are kept for late rows.
struct LateBlocks {
  std::size_t range = 0;  ///< the subdomain's in RowShares::ranges: grows over them
  std::size_t first = 0;  ///< all of them: first .. end
  std::size_t end = 0;
};

/// Candidates that are not rows: the first `count` lanes of the blocks; other lanes are void.
template <class Real>
struct Spares {
  std::vector<RowBlock<Real>> blocks;
  std::size_t count = 0;
};

/// An impulse of a contact that pushed, under the name of its second side.
template <class Real>
struct CarriedImpulse {
  std::int32_t other;  ///< the second grain, or Grains::wall_name of a wall
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
  std::vector<std::size_t> first_block;              ///< of each subdomain in the rows of all
  std::vector<std::uint64_t> open_blocks;  ///< per grain: one bit for each open block it is in
  ByGrain<CarriedImpulse<Real>> carried;   ///< by the first grain of each contact
  std::vector<Real> pair_impulse;          ///< what each pair carries
  std::vector<GrainPair> near;             ///< pairs that become rows
};

/// Rows and impulses; the impulse of lane k of block b is `impulse[b * block_width + k]`.
template <class Real>
struct Contacts<Sphere, Real> {
  std::vector<RowBlock<Real>> rows;
  std::size_t pair_blocks = 0;
  std::vector<WallRows> walls;
  std::size_t first_round = 0;  ///< first block of a round wall; number of blocks if there is none
  RowShares shares;
  std::vector<Real> impulse;
  std::vector<Real> extrapolated;  ///< the solver's look-ahead impulses
  std::vector<Real> changed_from;  ///< while impulses are changes of other impulses: these; else
                                   ///< empty
  std::vector<double> sunk;        ///< of each part of a detection: see `update_gaps`
  Spares<Real> spares;
  std::vector<LateBlocks> late;             ///< of each subdomain
  std::size_t taken_pairs = 0;              ///< so many of the candidates are rows or spares
  std::vector<std::size_t> taken_at_walls;  ///< so many of each wall's candidates are rows
  LayoutColumns<Real> layout;

  std::size_t blocks_of_row(const WallRows& wall) const { return wall.first < first_round ? 1 : 2; }

  // What the solver needs of contacts of any kind: how many records of motion a grain has, whether
  // its rows may hold it more often than it can move, and what its kernels do to the rows of a
  // range.
  static constexpr std::size_t records_of_grain = 1;
  static constexpr bool may_circle = false;  ///< see GaussSeidel::leave_circle
  SweepSums<Real> sweep(const Kernels& all, BlockRange range, const SweepRule<Real>& rule,
                        Record<Real>* u) {
    const RowKernels<Real>& kernels = kernels_of<Real>(all).rows;
    const std::size_t at = range.first * block_width;
    return (range.first < first_round ? kernels.gauss_seidel_sweep : kernels.round_sweep)(
        rows.data() + range.first, range.blocks, from(at), u, impulse.data() + at,
        extrapolated.data() + at, rule);
  }
  Missed<Real> residual(const Kernels& all, BlockRange range, const Record<Real>* u) const {
    const RowKernels<Real>& kernels = kernels_of<Real>(all).rows;
    const std::size_t at = range.first * block_width;
    return (range.first < first_round ? kernels.residual : kernels.round_residual)(
        rows.data() + range.first, range.blocks, from(at), u, impulse.data() + at);
  }
  /// No contact pushes.
  void drop_impulses() {
    std::fill(impulse.begin(), impulse.end(), Real(0));
    for (std::size_t at = 0; at < changed_from.size(); ++at) impulse[at] = -changed_from[at];
  }
  void accumulate(const Kernels& all, BlockRange range, Record<Real>* accumulated) const {
    kernels_of<Real>(all).rows.accumulate_impulses(rows.data() + range.first, range.blocks,
                                                   impulse.data() + range.first * block_width,
                                                   accumulated);
  }

 private:
  /// The impulses of which those from place `at` on are changes; null where they are whole.
  const Real* from(std::size_t at) const {
    return changed_from.empty() ? nullptr : changed_from.data() + at;
  }
};
template <class Real>
using SphereContacts = Contacts<Sphere, Real>;

/// Lays all candidates out as rows; contacts that were there before keep their impulse.
template <class Real>
void lay_out(const SphereBed& bed, const Candidates& candidates, SphereContacts<Real>& contacts,
             const ParallelFor& loop = serial_for);

/// Before a step: completes the candidates, and makes rows of all with a gap below `near`. If rows
/// have to be laid out anew, all candidates with a gap below `reach` become rows. Rows that were
/// there before keep their impulse. Returns whether the bed was searched for candidates anew.
template <class Real>
bool renew_rows(double near, double reach, const ExecutionContext& context, SphereBed& bed,
                Candidates& candidates, SphereContacts<Real>& contacts);

/// Lays out the candidates with a gap below `tolerance`, d, as rows without a gap, for a step of
/// length 1; for a round wall, rows of its tangent planes. Contacts keep the forces that they have
/// in `from` after a step of length `dt`.
template <class Real>
void lay_out_closed(double tolerance, const ExecutionContext& context, const SphereBed& bed,
                    const Candidates& candidates, double dt, const SphereContacts<Real>& from,
                    SphereContacts<double>& closed);

/// Measures normal and gap of every row. `correction`: share of an overlap that a step repairs.
/// Returns the most by which centres are nearer than sunk_share of the distance at which their
/// grains touch, d; 0 if none are.
template <class Real>
double update_gaps(const SphereBed& bed, const ExecutionContext& context, double correction,
                   SphereContacts<Real>& contacts);

/// Calls visit(block, lane, place of its impulse) for all rows that are swept: those of the same
/// grain never at the same time.
template <class Real, class Visit>
void visit_lanes(const SphereContacts<Real>& contacts, const ParallelFor& loop,
                 const Visit& visit) {
  visit_ranges(contacts.shares, loop, [&](BlockRange range) {
    for (std::size_t block = range.first; block < range.first + range.blocks; ++block) {
      for (std::size_t lane = 0; lane < block_width; ++lane) {
        visit(block, lane, block * block_width + lane);
      }
    }
  });
}
/// The contacts that bore a force in the last step, of length `dt`.
template <class Real>
std::vector<ForceContact> force_contacts(const SphereBed& bed, double dt,
                                         const SphereContacts<Real>& contacts);

/// How each contact of force_contacts is closed now. Measures the rows' gaps anew.
template <class Real>
std::vector<Closure> closures(SphereBed& bed, const ExecutionContext& context, double dt,
                              Candidates& candidates, SphereContacts<Real>& contacts);

}  // namespace grainsweep
