// Whether a bed is at rest, and by how much it misses.
//
// Without friction a bed of generic grains at rest carries exactly as many force-bearing contacts
// as it has degrees of freedom that are not free: 3 per sphere, 6 per polyhedron, less the zero
// modes. A bed still sliding has too few, and that is tested. Too many are no fault by themselves:
// faces that lie flat on each other bring more than are needed (hyperstatic), and beds that rest on
// each other too deeply fail by their overlaps.
//
// Of polyhedra that number is no law from below, either: a face that turns about a corner pushing
// it comes nearer to the corner's grain, so that forces hold soft motions which no contact blocks.
// Beds of icosahedra stay where they are, balanced to 0.2 % of their weights, on 0.977 of it. A bed
// of polyhedra that lacks contacts may therefore be at rest, but may as well slide softly on: its
// balance must then be twice as good.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/dynamics/step.hpp"
#include "engine/results.hpp"
#include "engine/scene/bed.hpp"

namespace grainsweep {

/// Largest and mean overlap, and counts, of a bed whose contacts hold the impulses of a step of
/// length `dt`. Measures the gaps anew; all contacts count as independent; what the last step did
/// and the imbalance are left at 0.
template <class Kind, class Real>
RestReport measure_rest(Bed<Kind>& bed, const ExecutionContext& context, double dt,
                        StepState<Kind, Real>& state);

/// Degrees of freedom that no contact can take up: every cluster of grains that stands on a wall
/// slides freely in each direction in which no wall pushes it, nor holds one of its spheres between
/// itself and the one across; a polyhedron that stands alone also turns about the wall's normal,
/// and in a tube every cluster about its axis, where that is no slide.
template <class Kind>
std::int64_t zero_modes(const Bed<Kind>& bed, const std::vector<ForceContact>& contacts);

/// Whether a contact is with a flat wall that holds the grain in place together with the one
/// across, with forces that are any: no constraint is counted for it, and no degree of freedom.
bool is_held_by(const SphereBed& bed, const ForceContact& contact);

/// The part of a force on a sphere that it is not held against by walls that it fills the space
/// between.
Vector free_part(const SphereBed& bed, std::size_t grain, const Vector& force);

/// Contacts that hold a bed without one too many: its degrees of freedom, less zero modes and those
/// of spheres that fill the space between two walls.
template <class Kind>
std::int64_t isostatic_count(const Bed<Kind>& bed, const std::vector<ForceContact>& contacts);

/// Grains that push each other, of each cluster that a floor pushes up and that turns about the
/// axis of a tube.
std::vector<std::vector<std::int32_t>> clusters_that_turn(
    const SphereBed& bed, const std::vector<ForceContact>& contacts);

/// Grains that push each other but no wall across `direction`: moved along it, all of them alike,
/// no contact opens or closes.
struct FreeMotion {
  std::vector<std::int32_t> grains;
  Vector direction;  ///< unit, box frame
};

/// The zero modes of spheres, one by one. Those of a tube are of its wall as it is, which holds
/// grains along it, too, but for turning them all about the axis.
std::vector<FreeMotion> free_motions(const SphereBed& bed,
                                     const std::vector<ForceContact>& contacts);

/// Of forces in f32, m g for every d of height.
inline constexpr double error_of_a_layer = 1e-4;

/// The forces between grains.
std::vector<PairForce> pair_forces(const Grains& bed, const std::vector<ForceContact>& contacts);

/// The forces of walls, one for each grain and wall, and of a round wall for each vertex of a
/// polyhedron: their normals differ.
template <class Kind>
std::vector<WallForce> wall_forces(const Bed<Kind>& bed, const std::vector<ForceContact>& contacts);

/// The lines of the forces of pair_forces, out of `lines`, those of `contacts`.
std::vector<ForceLine> pair_lines(const Grains& bed, const std::vector<ForceContact>& contacts,
                                  const std::vector<ForceLine>& lines);

/// The same of wall_forces.
std::vector<ForceLine> wall_lines(const PolyhedronBed& bed,
                                  const std::vector<ForceContact>& contacts,
                                  const std::vector<ForceLine>& lines);

/// Sum of the magnitudes of the contact forces on each grain, m g.
std::vector<double> force_sums(const Grains& bed, const std::vector<ForceContact>& contacts);

/// No single pair may overlap deeper than so many times what is allowed for the mean: one grain
/// stuck in another changes no mean.
inline constexpr double deepest_overlap = 100.0;

/// No single grain may miss balance by more than so many times what is allowed for the mean.
inline constexpr double largest_imbalance = 15.0;

/// Of a bed that rests on fewer contacts than degrees of freedom, by more than the tolerance, this
/// share of the tolerance of its imbalance.
inline constexpr double imbalance_share_of_few = 0.5;

/// Whether a bed has more contacts than degrees of freedom by more than the tolerance.
bool is_hyperstatic(const RestReport& rest, const Accuracy& accuracy);

/// In longer steps gravity outruns the longest motion of a step, and beds may not come to rest,
/// sqrt(d/g).
inline constexpr double longest_settling_step = 0.4;

/// The first test of rest that `rest` fails and what to change, in words; empty if it passes all.
/// `may_go_on`: accuracy.max_steps left steps to come to rest in.
std::string rest_failure(const RestReport& rest, const Accuracy& accuracy, bool may_go_on = true);

/// How to change the steps of a bed that ran out of them, in words.
std::string remedy_of_steps(const Accuracy& accuracy);

/// What to do about the residual of a bed not at rest whose highest grain lies at `height`, d, if
/// it is f32 that keeps it from being smaller; "" if not.
std::string remedy_of_rounding(const RestReport& rest, const Accuracy& accuracy, double height);

}  // namespace grainsweep
