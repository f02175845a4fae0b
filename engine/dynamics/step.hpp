// One step of the heavy-ball displacement protocol.
//
// Without contacts a grain would move by u_free = alpha u_last + g dt^2, and a polyhedron turn by
// alpha times what keeps its angular momentum, each clamped; the contacts change that as little as
// is needed to keep all gaps open (to first order in the angles), and the grains move by the
// result. With alpha = 1 and a small dt this is Moreau's contact dynamics; below 1 it is a damped
// descent to rest.
#pragma once

#include "engine/broad/candidates.hpp"
#include "engine/dynamics/solve.hpp"
#include "engine/rows/polyhedron_contacts.hpp"
#include "engine/rows/sphere_contacts.hpp"
#include "engine/scene/bed.hpp"

namespace grainsweep {

/// Longest motion of a grain in one step whatever pushes it, d; its turn moves no corner further. A
/// solve that is cut short between grains of very different mass may push the light grain with the
/// weight of the heavy one; that must not throw it through its neighbours.
inline constexpr double longest_motion = 0.3;

/// Longest motion of a grain in a step after which another one is taken on the same contacts, in
/// radii of the largest ball within the grain: plates and needles lie on each other along lines and
/// faces that turn by more for the same distance.
inline constexpr double longest_on_same_contacts = 0.2;

struct StepSettings {
  double dt = 0.2;          ///< sqrt(d/g)
  double momentum = 0.9;    ///< alpha
  double correction = 0.1;  ///< share of an overlap that the step repairs
  double near = 0.08;       ///< pairs with a smaller gap are rows, d
  double margin = 0.05;     ///< a layout of rows (of polyhedra: the list of candidates) reaches
                            ///< this much further, d
  SolveLimits limits;       ///< tolerance in m g here; `step` turns it into a mass times d
  /// Longest free motion, d: so short that no grain passes another.
  double longest_free = 0.15;
  double longest = longest_motion;  ///< longest motion of a grain, d
  bool carries = false;  ///< impulses begin such that they carry a tall bed (columns.hpp)
  /// For polyhedra, whose contacts take longer to find than to solve: how many steps are taken on
  /// the contacts that the first one finds. The gaps of the steps after it are right to first order
  /// in the motion, as are those at the end of every step.
  int steps = 1;
};

/// What a step did, or all steps that were taken on its contacts.
struct StepReport {
  int steps = 0;
  SolveReport solve;            ///< of the last step, except iterations; residuals in m g
  double kinetic_energy = 0.0;  ///< mean of 1/2 m (u/dt)^2 of the grains awake, m g d
  /// Root mean square motion of the grains awake, weighted by mass, d; turning counts by its
  /// energy.
  double mean_motion = 0.0;
  double largest_motion = 0.0;      ///< d
  double motion_of_inradius = 0.0;  ///< the same for polyhedra, in radii of the ball within each
  /// Share of the weight of the grains awake that walls and grains asleep carry.
  double carried = 0.0;
  /// How far contacts strayed because a step was not solved better, d: the root mean square of the
  /// residuals of the rows that push, times their number over that of all degrees of freedom.
  /// Summed over the steps.
  double spurious_path = 0.0;
  /// Most by which, before the step, centres were nearer than sunk_share of the distance at which
  /// their grains (of polyhedra: the balls within them) touch, d.
  double sunk = 0.0;
};

/// How some grains moved in a step.
struct Moved {
  double energy = 0.0;       ///< sum of m u^2, m d^2
  double longest = 0.0;      ///< longest way, d
  double lift = 0.0;         ///< sum of m times what contacts add to the motion upwards, m d
  double mass = 0.0;         ///< of those awake, m
  double awake = 0.0;        ///< number of them
  double of_inradius = 0.0;  ///< longest way of a polyhedron, in radii of its largest ball
};

/// Everything that steps need besides the bed. After a step the contacts are those it found, before
/// the grains moved, with their impulses.
template <class Kind, class Real>
struct StepState {
  Candidates candidates;
  Contacts<Kind, Real> contacts;
  MotionColumns<Real> motion;
  std::vector<Moved> moved;  ///< of each part of the grains
};

/// One step, or settings.steps of them, fewer where grains move far. For polyhedra the largest
/// motion includes how far a turn moves a point at the circumradius, and the kinetic energy
/// includes turning.
template <class Kind, class Real>
StepReport step(const StepSettings& settings, const ExecutionContext& context, Bed<Kind>& bed,
                StepState<Kind, Real>& state);

/// Keeps velocities as they are when the next step is `ratio` times as long as the last one:
/// motions scale with `ratio`, impulses with its square.
template <class Kind, class Real>
void change_step(double ratio, Bed<Kind>& bed, StepState<Kind, Real>& state);

}  // namespace grainsweep
