// What is known of a bed of spheres that calls itself settled, whoever it was made by.
#pragma once

#include <map>

#include "engine/dynamics/settle.hpp"
#include "tests/extremes/scene.hpp"
#include "tests/support/named_contacts.hpp"

namespace grainsweep::extremes {

/// A bed after `settle`, and its contact forces.
struct SettledBed {
  SphereBed bed;
  Accuracy accuracy;
  SettleReport report;
  std::map<testing::ContactName, double> forces;  ///< m g, of every contact with a force

  /// Force of a contact; 0 if there is none.
  double force(std::int32_t a, std::int32_t b) const;
  /// Sum of the forces on the floor, m g.
  double on_floor() const;
  double weight() const;  ///< of all grains, m g
};
SettledBed settle_scene(SphereBed bed, const Accuracy& accuracy);

/// Takes the forces that were reported.
void collect_forces(const std::vector<PairForce>& pairs, const std::vector<WallForce>& walls,
                    SettledBed& settled);

/// Length of the last steps of a bed that has settled, sqrt(d/g).
double last_step(const Accuracy& accuracy);

/// Largest share of a bed's weight that its accuracy may leave unbalanced. In the last step,
/// without momentum, an unbalanced acceleration a moves a grain by a dt^2. By Cauchy's inequality
/// the sum of all m a is at most sqrt(2 N k M) / dt, k the mean kinetic energy, M the mass of all.
/// Where the bed moves less than the accuracy would let it, its own k counts, and what rows do not
/// show as motion: a row of residual r lets its two grains accelerate by r over their reduced mass,
/// at most 2 r over the least mass; N rows below a grain add up.
double unbalance_bound(const SettledBed& settled);

/// Widest gap that a row with a residual r may leave: r dt^2 over the reduced mass, d.
double gap_bound(const Accuracy& accuracy, double reduced_mass);

/// What holds for any bed at rest: the floor carries the weight, no two grains overlap (looked at
/// pair by pair), none is outside the box.
std::vector<Answer> answers_of_any_bed(const SettledBed& settled);

/// The finding of a settled bed with these answers.
Finding finding_of(const SettledBed& settled, std::vector<Answer> answers);

/// Number of pairs, walls and floors with a gap below `tolerance`, d, looked at pair by pair.
double touching_count(const SphereBed& bed, double tolerance);

/// Lowest gap over all pairs and walls, d, and the sum of all overlaps.
struct Overlaps {
  double deepest = 0.0;
  double sum = 0.0;
};
Overlaps overlaps_of(const SphereBed& bed);

}  // namespace grainsweep::extremes
