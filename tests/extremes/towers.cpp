#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/text.hpp"
#include "tests/extremes/accuracy_names.hpp"
#include "tests/extremes/catalogue.hpp"
#include "tests/extremes/judge.hpp"
#include "tests/extremes/zigzag.hpp"

namespace grainsweep::extremes {

namespace {

/// Largest error of a force of the tower over the weight of all.
double force_error(const SettledBed& settled, const std::vector<double>& masses) {
  const std::vector<double> carried = carried_weights(masses);
  const SphereBed& bed = settled.bed;
  double worst = std::abs(settled.force(0, bed.wall()) - carried[0]);
  for (std::size_t k = 0; k < masses.size(); ++k) {
    const auto grain = static_cast<std::int32_t>(k);
    const double below = k == 0 ? 0.0 : carried[k],
                 above = k + 1 < masses.size() ? carried[k + 1] : 0.0;
    const double on_wall = zigzag_across * (below + above) / zigzag_rise;
    const std::size_t low_x = k % 2 == 0 ? 1 : 2, low_y = k % 2 == 0 ? 3 : 4;
    if (k > 0)
      worst = std::max(worst, std::abs(settled.force(grain - 1, grain) - below / zigzag_rise));
    worst =
        std::max(worst, std::abs(settled.force(grain, testing::wall_name(bed, low_x)) - on_wall));
    worst =
        std::max(worst, std::abs(settled.force(grain, testing::wall_name(bed, low_y)) - on_wall));
  }
  return worst / carried[0];
}

/// Largest distance of a grain from its place, d.
double place_error(const SettledBed& settled) {
  const SphereBed exact = zigzag_bed(std::vector<double>(settled.bed.grains(), 1.0), 0.0);
  double worst = 0.0;
  for (std::size_t k = 0; k < exact.grains(); ++k) {
    const Record<double>&p = settled.bed.position[k], &q = exact.position[k];
    worst = std::max(worst, std::hypot(p.x - q.x, p.y - q.y, p.z - q.z));
  }
  return worst;
}

/// Answers of a settled tower. A force is that of a wall or pair, up to 1.2 / h times the weight it
/// carries; a gap of a row moves all grains above it, 1 / h times as far.
std::vector<Answer> answers(const SettledBed& settled, const std::vector<double>& masses) {
  const double lightest = *std::min_element(masses.begin(), masses.end());
  const auto grains = static_cast<double>(masses.size());
  const double gap = gap_bound(settled.accuracy, lightest / 2.0);
  std::vector<Answer> all = answers_of_any_bed(settled);
  all.push_back({"any force over the weight", force_error(settled, masses),
                 1.2 / zigzag_rise * unbalance_bound(settled),
                 "what the accuracy leaves unbalanced"});
  all.push_back({"any grain's place, d", place_error(settled),
                 3.0 * grains * (gap + settled.accuracy.overlap_tolerance) / zigzag_rise,
                 "gaps that the accuracy leaves open, three a grain, added up"});
  return all;
}

Finding settle_tower(const std::vector<double>& masses, const Accuracy& accuracy) {
  const SettledBed settled = settle_scene(zigzag_bed(masses, 1e-3), accuracy);
  return finding_of(settled, answers(settled, masses));
}

/// Without enough iterations the grains of the tallest towers sink into each other, which is
/// noticed.
Scene tower(int grains, const NamedAccuracy& at) {
  const bool enough = grains <= 200;
  const std::vector<double> masses(static_cast<std::size_t>(grains), 1.0);
  return {"towers",
          "tower of " + std::to_string(grains),
          "the lowest contact carries " + std::to_string(grains - 1) + " grains",
          at.name,
          enough ? Outcome::right : Outcome::not_settled,
          [=] { return settle_tower(masses, at.accuracy); }};
}

Scene two_masses(double below, double above, const NamedAccuracy& at, Outcome expected) {
  return {"masses",
          number_text(above, 6) + " on " + number_text(below, 6),
          "masses " + number_text(std::max(below, above) / std::min(below, above), 6) + " to 1",
          at.name,
          expected,
          [=] {
            return settle_tower({below, above}, at.accuracy);
          }};
}

}  // namespace

std::vector<Scene> towers() {
  std::vector<Scene> scenes;
  for (const char* name : {"fast", "balanced", "accurate"}) {
    for (const int grains : {2, 3, 5, 10, 20, 50, 100, 200, 500}) {
      scenes.push_back(tower(grains, at_preset(name)));
    }
  }
  scenes.push_back(tower(1000, at_preset("balanced")));
  for (const int grains : {2, 3, 5, 10, 20, 50, 100}) {
    scenes.push_back(tower(grains, tight()));
  }
  return scenes;
}

std::vector<Scene> masses() {
  std::vector<Scene> scenes = {two_masses(1, 1, at_preset("balanced"), Outcome::right),
                               two_masses(1, 1, tight(), Outcome::right)};
  const auto add = [&](double ratio, double below, double above, Outcome tightly) {
    // f32 carries masses up to 1e5 apart, and says so of others.
    const Outcome balanced = ratio < 1e5 ? Outcome::right : Outcome::not_settled;
    scenes.push_back(two_masses(below, above, at_preset("balanced"), balanced));
    scenes.push_back(two_masses(below, above, tight(), tightly));
  };
  for (const double ratio : {10.0, 100.0, 1e3, 1e4, 1e6, 1e8}) {
    // 1e-9 m g of the mass of d is beyond the digits of weights of 1e6 and of what 1e-8 leaves.
    const Outcome up_to_1e4 = ratio <= 1e4 ? Outcome::right : Outcome::not_settled;
    const Outcome up_to_1e6 = ratio <= 1e6 ? Outcome::right : Outcome::not_settled;
    add(ratio, 1.0, ratio, up_to_1e4);
    add(ratio, ratio, 1.0, Outcome::right);
    add(ratio, 1.0 / ratio, 1.0, up_to_1e6);
    add(ratio, 1.0, 1.0 / ratio, up_to_1e6);
  }
  return scenes;
}

}  // namespace grainsweep::extremes
