// Whether a bed is at rest, and how far it is from rest.
//
// Without friction a bed of generic grains at rest carries exactly as many force-bearing contacts
// as it has degrees of freedom that are not free: 3 per sphere, 6 per polyhedron, less the zero
// modes. A bed still sliding has too few, and that is tested. Too many are no fault by themselves:
// faces that lie flat on each other bring more than are needed (hyperstatic), and beds that rest on
// each other too deeply fail by their overlaps.
//
// For polyhedra that number is no lower bound, either: a face that turns about a corner pushing it
// comes nearer to the corner's grain, so that forces hold soft motions which no contact blocks.
// Beds of icosahedra stay where they are, balanced to 0.2 % of their weights, on 0.977 of that
// number. A bed of polyhedra with too few contacts may therefore be at rest, but may also still
// slide softly: its balance must then be twice as good.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
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
/// slides freely in each direction in which no wall pushes it and no two walls hold one of its
/// spheres between them; a polyhedron that stands alone also turns about the wall's normal, and
/// every cluster in a tube turns about the tube's axis, unless slides or turns already include
/// that.
template <class Kind>
std::int64_t zero_modes(const Bed<Kind>& bed, const std::vector<ForceContact>& contacts);

/// Whether a contact is with a flat wall that, with the wall across, holds the grain in place
/// whatever their forces are: no constraint is counted for it, and no degree of freedom.
bool is_held_by(const SphereBed& bed, const ForceContact& contact);

/// The part of a force on a sphere along directions in which it does not fill the space between two
/// flat walls.
Vector free_part(const SphereBed& bed, std::size_t grain, const Vector& force);

/// Number of contacts that hold a bed without one too many: its degrees of freedom, less zero modes
/// and those in which spheres fill the space between two walls.
template <class Kind>
std::int64_t isostatic_count(const Bed<Kind>& bed, const std::vector<ForceContact>& contacts);

/// The grains of each cluster, which push each other, that the floor pushes up and that can turn
/// about the axis of a tube.
std::vector<std::vector<std::int32_t>> clusters_that_turn(
    const SphereBed& bed, const std::vector<ForceContact>& contacts);

/// Grains that push each other but no wall across `direction`: when all move along it alike, no
/// contact opens or closes.
struct FreeMotion {
  std::vector<std::int32_t> grains;
  Vector direction;  ///< unit, box frame
};

/// The zero modes of spheres, one by one. In a tube they take the wall as it is, round: it also
/// holds grains along it, except against turning all of them about the axis.
std::vector<FreeMotion> free_motions(const SphereBed& bed,
                                     const std::vector<ForceContact>& contacts);

/// Error of forces in f32, m g for every d of height.
inline constexpr double error_of_a_layer = 1e-4;

/// Forces, and the line of each.
template <class Force>
using WithLines = std::pair<std::vector<Force>, std::vector<ForceLine>>;

/// The forces between grains. `lines` has one for each of `contacts`, or none, as of spheres; then
/// the forces have none.
WithLines<PairForce> pair_forces(const Grains& bed, const std::vector<ForceContact>& contacts,
                                 const std::vector<ForceLine>& lines);

/// The same of walls, one for each grain and wall; at a round wall one for each vertex of a
/// polyhedron, since their normals differ.
template <class Kind>
WithLines<WallForce> wall_forces(const Bed<Kind>& bed, const std::vector<ForceContact>& contacts,
                                 const std::vector<ForceLine>& lines);

/// Sum of the magnitudes of the contact forces on each grain, m g.
std::vector<double> force_sums(const Grains& bed, const std::vector<ForceContact>& contacts);

/// No single pair may overlap deeper than so many times what is allowed for the mean: one grain
/// stuck in another changes no mean.
inline constexpr double deepest_overlap = 100.0;

/// No single grain may miss balance by more than so many times what is allowed for the mean.
inline constexpr double largest_imbalance = 15.0;

/// A bed that rests on fewer contacts than degrees of freedom, by more than the tolerance, is
/// allowed this share of the imbalance tolerance.
inline constexpr double imbalance_share_of_few = 0.5;

/// Whether a bed has more contacts than degrees of freedom by more than the tolerance.
bool is_hyperstatic(const RestReport& rest, const Accuracy& accuracy);

/// Longest step in which beds settle, sqrt(d/g): in longer ones gravity outruns the longest motion
/// of a step, and beds may not come to rest.
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
