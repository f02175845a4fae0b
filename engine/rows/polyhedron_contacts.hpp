// Contacts of polyhedra: found anew in each step, subdomain by subdomain, and laid out as rows of
// their points.
//
// Contacts with many points come first in a subdomain, so that the contacts of a block have about
// the same number of them; no two lanes of a block share a grain.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "engine/broad/candidates.hpp"
#include "engine/context.hpp"
#include "engine/narrow/polyhedra.hpp"
#include "engine/results.hpp"
#include "engine/rows/contacts.hpp"
#include "engine/rows/pair_memories.hpp"
#include "engine/rows/partition.hpp"
#include "engine/rows/subdomains.hpp"
#include "engine/rows/travel.hpp"
#include "engine/scene/bed.hpp"
#include "kernels/kernels.hpp"

namespace grainsweep {

/// An impulse of a point that pushed.
struct CarriedPoint {
  std::int32_t other = 0;            ///< the second side of its contact
  Vector position = Vector::Zero();  ///< about the centre of the first grain, its frame, d
  double impulse = 0.0;              ///< masses times d
};

/// The contacts of one subdomain, and their rows until they are joined with those of the others.
template <class Real>
struct ContactPart {
  ContactList found;
  /// The impulse of point j of contact k is impulse[first[k] + j * block_width].
  std::vector<std::size_t> first;
  std::vector<BodyBlock<Real>> blocks;
  std::vector<BodyPoints<Real>> points;
  std::vector<Real> impulse;
  double sunk = 0.0;               ///< see touch_pairs
  std::vector<std::size_t> order;  ///< memory of the layout: contacts as they are laid out
  NarrowColumns narrow;
};

/// The impulse of lane k of points[i] is `impulse[i * block_width + k]`.
template <class Real>
struct Contacts<Polyhedron, Real> {
  Subdomains subdomains;
  std::vector<PairMemory> memory;  ///< of each of subdomains.pairs, if they have any
  Travel travel;
  std::vector<double> far_until, spare_until;  ///< of each of subdomains.pairs; see FarPairs
  PairMemoryColumns listed_before;
  std::vector<PairMemory> spare_memory;
  std::vector<ContactPart<Real>> parts;  ///< memory of more than `found_parts` may be left
  std::size_t found_parts = 0;           ///< parts that the last step found
  std::vector<BodyBlock<Real>> blocks;
  std::vector<BodyPoints<Real>> points;
  RowShares shares;
  std::vector<Real> impulse;
  std::vector<Real> extrapolated;  ///< the solver's look-ahead impulses
  ByGrain<CarriedPoint> carried;   ///< from the last step, by the first grain of each contact
  std::vector<std::uint64_t> open_blocks;  ///< per grain: one bit for each open block it is in

  // As for spheres; a block itself says where its impulses are.
  static constexpr std::size_t records_of_grain = 2;
  static constexpr bool may_circle = true;
  SweepSums<Real> sweep(const Kernels& all, BlockRange range, const SweepRule<Real>& rule,
                        Record<Real>* u) {
    return kernels_of<Real>(all).bodies.gauss_seidel_sweep(
        rows_of(range), range.blocks, u, impulse.data(), extrapolated.data(), rule);
  }
  /// No contact pushes.
  void drop_impulses() { std::fill(impulse.begin(), impulse.end(), Real(0)); }
  Missed<Real> residual(const Kernels& all, BlockRange range, const Record<Real>* u) const {
    return kernels_of<Real>(all).bodies.residual(rows_of(range), range.blocks, u, impulse.data());
  }
  void accumulate(const Kernels& all, BlockRange range, Record<Real>* accumulated) const {
    kernels_of<Real>(all).bodies.accumulate_impulses(rows_of(range), range.blocks, impulse.data(),
                                                     accumulated);
  }
  /// Gaps after the motion u of all grains, to first order in it; all else of the contacts stays.
  /// `correction` as in find_contacts.
  void move_gaps(const Kernels& all, BlockRange range, const Record<Real>* u, double correction) {
    kernels_of<Real>(all).bodies.move_gaps(rows_of(range), range.blocks, u,
                                           static_cast<Real>(correction), points.data());
  }

 private:
  BodyRows<Real> rows_of(BlockRange range) const {
    return {blocks.data() + range.first, points.data()};
  }
};
template <class Real>
using PolyhedronContacts = Contacts<Polyhedron, Real>;

/// Contacts of a step in which grains fall freely by up to `drop` are those with a gap below
/// `near`, d.
TouchSettings touch_settings(double near, double drop);

/// Forgets the pairs and what they remember.
template <class Real>
void forget_pairs(PolyhedronContacts<Real>& contacts) {
  contacts.subdomains.pairs.clear();
  contacts.memory.clear();
  contacts.far_until.clear();
  contacts.travel = {};
}

/// Takes a new list of candidates; contacts stay what they are until they are found anew, and pairs
/// that were listed before remember what they did.
template <class Real>
void take_candidates(const PolyhedronBed& bed, const Candidates& candidates,
                     PolyhedronContacts<Real>& contacts, const ParallelFor& loop = serial_for);

/// Adds to the moments of inertia, for a step, the stiffness with which forces of the last step
/// hold polyhedra: turned by t about an axis across its normal, a face comes nearer to what touches
/// it by t^2 / 2 times the distance from the grain's centre along the normal (if a sphere touches
/// it, the distance of the sphere's centre). Rows see this only after the step, so that grains
/// under many others, or light ones under a large force, would swing; with dt^2 times that
/// stiffness in their inertia they do not, and rest where they would rest without it. Of edges that
/// cross, each is held as a face is, about the other.
template <class Real>
void hold_turning(const PolyhedronContacts<Real>& contacts, const ParallelFor& loop,
                  PolyhedronBed& bed);

/// Undoes hold_turning: between steps moments of inertia are those of the grains alone.
void release_turning(const ParallelFor& loop, PolyhedronBed& bed);

/// Finds the contacts between the candidates taken last, lays out their rows, and gives the
/// impulses of the previous contacts to the nearest point of the contact between the same two,
/// whatever its normal is now; impulses of contacts that no longer exist are dropped. `correction`:
/// share of an overlap that a step repairs. Returns what touch_pairs returns, d.
template <class Real>
double find_contacts(const TouchSettings& settings, double correction, const PolyhedronBed& bed,
                     const ExecutionContext& context, PolyhedronContacts<Real>& contacts);

/// Finds the contacts between the candidates and lays out their points with a gap below
/// `tolerance`, d, as rows without a gap, for a step of length 1. Contacts keep the forces that
/// they have in `from` after a step of length `dt`.
template <class Real>
void lay_out_closed(double tolerance, const ExecutionContext& context, const PolyhedronBed& bed,
                    const Candidates& candidates, double dt, const PolyhedronContacts<Real>& from,
                    PolyhedronContacts<double>& closed);

/// Impulse of point j of contact k of a part, in masses times d.
template <class Real>
double impulse_of(const PolyhedronContacts<Real>& contacts, const ContactPart<Real>& part,
                  std::size_t k, std::size_t j) {
  return static_cast<double>(contacts.impulse[part.first[k] + j * block_width]);
}

/// The contacts that bore a force in the last step, of length `dt`.
template <class Real>
std::vector<ForceContact> force_contacts(const PolyhedronBed& bed, double dt,
                                         const PolyhedronContacts<Real>& contacts);

/// How the force of each contact of force_contacts acts, with its grains turned as they are now.
template <class Real>
std::vector<ForceLine> force_lines(const PolyhedronBed& bed,
                                   const PolyhedronContacts<Real>& contacts, double dt);

/// The contacts of force_contacts that are closed now, as they are now.
template <class Real>
std::vector<ContactList> closed_contacts(PolyhedronBed& bed, const ExecutionContext& context,
                                         double dt, const PolyhedronContacts<Real>& contacts);

/// How each contact of force_contacts is closed now. The candidates, and the bed's places in the
/// box, may be renewed.
template <class Real>
std::vector<Closure> closures(PolyhedronBed& bed, const ExecutionContext& context, double dt,
                              Candidates& candidates, PolyhedronContacts<Real>& contacts);

}  // namespace grainsweep
