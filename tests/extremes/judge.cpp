#include "tests/extremes/judge.hpp"

#include <algorithm>
#include <cmath>

#include "engine/dynamics/stages.hpp"

namespace grainsweep::extremes {

namespace {

double nearest(double difference, double period) {
  return period > 0.0 ? difference - period * std::round(difference / period) : difference;
}

double gap_of(const SphereBed& bed, std::size_t a, std::size_t b) {
  const Record<double>&p = bed.position[a], &q = bed.position[b];
  return std::hypot(nearest(p.x - q.x, bed.box.period_x()), nearest(p.y - q.y, bed.box.period_y()),
                    p.z - q.z) -
         p.w - q.w;
}

/// Calls visit(gap) for every pair and every wall of a grain.
template <class Visit>
void visit_gaps(const SphereBed& bed, Visit visit) {
  for (std::size_t a = 0; a < bed.grains(); ++a) {
    for (std::size_t b = a + 1; b < bed.grains(); ++b) visit(gap_of(bed, a, b));
    for (const Wall& wall : bed.walls) visit(wall.gap(bed.position[a]));
  }
}

void add_gap(double gap, Overlaps& overlaps) {
  overlaps.deepest = std::max(overlaps.deepest, -gap);
  overlaps.sum += std::max(0.0, -gap);
}

double min_mass(const SphereBed& bed) {
  double most = 0.0;
  for (std::size_t i = 0; i < bed.grains(); ++i) most = std::max(most, bed.motion[i].w);
  return 1.0 / most;
}

}  // namespace

void collect_forces(const std::vector<PairForce>& pairs, const std::vector<WallForce>& walls,
                    SettledBed& settled) {
  for (const PairForce& pair : pairs) settled.forces[{pair.a, pair.b}] = pair.magnitude;
  for (const WallForce& wall : walls) {
    settled.forces[{wall.grain, settled.bed.wall_name(static_cast<std::size_t>(wall.wall))}] =
        wall.magnitude;
  }
}

double SettledBed::force(std::int32_t a, std::int32_t b) const {
  const auto found = forces.find({a, b});
  return found == forces.end() ? 0.0 : found->second;
}

double SettledBed::on_floor() const {
  double sum = 0.0;
  for (const auto& [name, force] : forces) sum += name.second == bed.wall() ? force : 0.0;
  return sum;
}

double SettledBed::weight() const {
  double sum = 0.0;
  for (std::size_t i = 0; i < bed.grains(); ++i) sum += 1.0 / bed.motion[i].w;
  return sum;
}

SettledBed settle_scene(SphereBed bed, const Accuracy& accuracy) {
  SettledBed settled{std::move(bed), accuracy, {}, {}};
  settled.report =
      settle(accuracy, kernels_for(best_isa()), settled.bed, [](const Progress&) { return true; });
  collect_forces(settled.report.forces, settled.report.wall_forces, settled);
  return settled;
}

double last_step(const Accuracy& accuracy) {
  const Stages stages = stages_of<Sphere>(accuracy.protocol);
  const auto rest = std::find_if(stages.begin(), stages.end(), [](const StageRule& stage) {
    return stage.end == StageEnd::rest;
  });
  return settings_of(accuracy, *rest).dt;
}

double unbalance_bound(const SettledBed& settled) {
  const auto grains = static_cast<double>(settled.bed.grains());
  const auto by_motion = [&](double kinetic_energy) {
    return std::sqrt(2.0 * kinetic_energy * grains / settled.weight()) /
           last_step(settled.accuracy);
  };
  const double by_rows = 2.0 * grains * settled.accuracy.residual_tolerance / min_mass(settled.bed);
  return std::min(by_motion(settled.accuracy.kinetic_tolerance),
                  by_motion(settled.report.rest.kinetic_energy) + by_rows);
}

double gap_bound(const Accuracy& accuracy, double reduced_mass) {
  const double dt = last_step(accuracy);
  return accuracy.residual_tolerance * dt * dt / reduced_mass;
}

Overlaps overlaps_of(const SphereBed& bed) {
  Overlaps overlaps;
  visit_gaps(bed, [&](double gap) { add_gap(gap, overlaps); });
  return overlaps;
}

double touching_count(const SphereBed& bed, double tolerance) {
  double count = 0.0;
  visit_gaps(bed, [&](double gap) { count += gap < tolerance ? 1.0 : 0.0; });
  return count;
}

std::vector<Answer> answers_of_any_bed(const SettledBed& settled) {
  const Overlaps overlaps = overlaps_of(settled.bed);
  const auto contacts =
      static_cast<double>(std::max<std::int64_t>(settled.report.rest.contacts, 1));
  const double overlap = settled.accuracy.overlap_tolerance;
  return {
      {"weight on the floor, relative", std::abs(settled.on_floor() / settled.weight() - 1.0),
       unbalance_bound(settled), "what the accuracy leaves unbalanced"},
      {"mean overlap of any pair or wall, d", overlaps.sum / contacts, 1.1 * overlap,
       "promised for contacts that bear a force; some overlaps bear none, and some contacts are "
       "still open"},
      {"deepest overlap of any pair or wall, d", overlaps.deepest,
       std::min(overlap * contacts, 0.01),
       "no more than the mean over all contacts allows, and never a hundredth of a grain"}};
}

Finding finding_of(const SettledBed& settled, std::vector<Answer> answers) {
  const std::string& failure = settled.report.failure;
  const char* sank = settled.report.sank ? "two grains sank into each other by more than half" : "";
  return {{}, failure.empty() ? sank : failure, is_finite(settled.bed), std::move(answers)};
}

}  // namespace grainsweep::extremes
