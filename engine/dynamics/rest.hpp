// Whether a bed is at rest, and by how much it misses.
//
// Without friction a bed at rest carries exactly as many force-bearing contacts as it has degrees
// of freedom that are not free: 3 per grain, less the zero modes. Loose solves leave overlaps and
// too many contacts, a bed still sliding has too few; so the count is a check on everything else.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/results.hpp"
#include "engine/rows/contacts.hpp"
#include "engine/scene/bed.hpp"

namespace grainsweep {

/// Forces below this do not make a contact force-bearing, m g.
inline constexpr double least_force = 1e-6;

/// A contact counts only once it is closed to this, d: what grains are said to touch at. Forces on
/// light grains can be small against every tolerance while their gaps are still open.
inline constexpr double closed_gap = 1e-4;

/// Calls visit(block, lane) for each row whose force counts.
template <class Real, class Visit>
void visit_force_bearing(const Contacts<Real>& contacts, double dt, Visit visit) {
  const double least = least_force * dt * dt;
  for (std::size_t block = 0; block < contacts.rows.size(); ++block) {
    for (std::size_t lane = 0; lane < block_width; ++lane) {
      if (static_cast<double>(contacts.impulse[block * block_width + lane]) > least) {
        visit(block, lane);
      }
    }
  }
}

/// Largest and mean overlap, and counts, of a bed whose contacts hold the impulses of a step of
/// length `dt`. Measures the gaps anew; residual, kinetic energy and motion are left at 0.
template <class Real>
RestReport certify(const SphereBed& bed, const ExecutionContext& context, double dt,
                   Contacts<Real>& contacts);

/// Degrees of freedom that no contact can take up: every cluster of grains that stands on the floor
/// slides freely along each horizontal axis in which no wall pushes it.
template <class Real>
std::int64_t zero_modes(const SphereBed& bed, const Contacts<Real>& contacts, double dt);

/// Share of the grains' weight that the floor carries.
template <class Real>
double carried_weight(const SphereBed& bed, const Contacts<Real>& contacts, double dt);

/// All pairs that bear a force.
template <class Real>
std::vector<PairForce> pair_forces(const SphereBed& bed, const Contacts<Real>& contacts, double dt);

/// Sum of the magnitudes of the contact forces on each grain, m g.
template <class Real>
std::vector<double> force_sums(const SphereBed& bed, const Contacts<Real>& contacts, double dt);

/// No single pair may overlap deeper than so many times what is allowed for the mean: one grain
/// stuck in another changes no mean.
inline constexpr double deepest_overlap = 100.0;

/// The first test of rest that `rest` fails, in words; empty if it passes all.
std::string why_not_at_rest(const RestReport& rest, const Accuracy& accuracy);

}  // namespace grainsweep
