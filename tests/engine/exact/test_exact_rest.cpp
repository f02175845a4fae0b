#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include <Eigen/QR>
#include <catch2/catch.hpp>

#include "engine/dynamics/presets.hpp"
#include "engine/dynamics/rest.hpp"
#include "engine/dynamics/settle.hpp"
#include "engine/exact/exact_rest.hpp"
#include "engine/scene/start.hpp"
#include "tests/support/about.hpp"
#include "tests/support/brute_force.hpp"
#include "tests/support/instruction_sets.hpp"
#include "tests/support/keep_going.hpp"
#include "tests/support/scenes.hpp"

namespace grainsweep {
namespace {

using testing::always;
using testing::periodic;
using testing::walls;

SphereBed settled_bed(PackingSpec spec, std::vector<ForceContact>& contacts) {
  SphereBed bed = start<Sphere>(spec).value();
  const SettleReport report = settle(spec.accuracy, testing::kernels(), bed, always);
  REQUIRE(report.failure == "");
  for (const PairForce& force : report.forces) {
    contacts.push_back({force.a, force.b, force.magnitude});
  }
  return bed;
}

PackingSpec small_spec(const Box& box, std::int64_t grains, std::uint64_t key) {
  PackingSpec spec;
  spec.box = box;
  spec.fill = GrainCount{grains};
  spec.random_key = key;
  return spec;
}

/// The forces of a certificate and the weight, from normals found here; and all gaps, one by one.
void check_certificate(const SphereBed& bed, const ExactRest& rest) {
  std::vector<Vector> net(bed.grains(), Vector::Zero());
  for (std::size_t i = 0; i < bed.grains(); ++i) net[i].z() = -1.0 / bed.motion[i].w;
  for (const ForceContact& contact : rest.contacts) {
    CHECK(contact.force > 0.0);
    const auto a = static_cast<std::size_t>(contact.a), b = static_cast<std::size_t>(contact.b);
    const Record<double>& p = bed.position[a];
    if (bed.is_grain(contact.b)) {
      CHECK(std::abs(testing::gap_of(bed, contact.a, contact.b)) < 1e-10);
      const Vector push = contact.force * nearest_difference(bed, a, b).normalized();
      net[a] -= push;
      net[b] += push;
    } else {
      const Wall& wall = bed.walls[b - bed.grains()];
      CHECK(std::abs(wall.gap(p)) < 1e-10);
      const UnitVector n = wall.normal(p.x, p.y, p.z);
      net[a] += contact.force * Vector(n.x, n.y, n.z);
    }
  }
  for (const Vector& left : net) CHECK(left.norm() < exact_imbalance);
  CHECK(testing::pairs_closer_than(bed, -exact_overlap).empty());
  for (const Wall& wall : bed.walls) {
    for (const Record<double>& grain : bed.centres()) CHECK(wall.gap(grain) > -exact_overlap);
  }
}

/// Rank of the matrix that turns forces of the contacts into forces on the grains.
Eigen::Index rank_of(const SphereBed& bed, const std::vector<ForceContact>& contacts) {
  Eigen::MatrixXd h = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(3 * bed.grains()),
                                            static_cast<Eigen::Index>(contacts.size()));
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const auto a = static_cast<std::size_t>(contacts[k].a);
    const auto b = static_cast<std::size_t>(contacts[k].b);
    const auto column = static_cast<Eigen::Index>(k);
    const Record<double>& p = bed.position[a];
    if (bed.is_grain(contacts[k].b)) {
      const Vector n = nearest_difference(bed, a, b).normalized();
      h.block<3, 1>(static_cast<Eigen::Index>(3 * a), column) = -n;
      h.block<3, 1>(static_cast<Eigen::Index>(3 * b), column) = n;
    } else {
      const UnitVector n = bed.walls[b - bed.grains()].normal(p.x, p.y, p.z);
      h.block<3, 1>(static_cast<Eigen::Index>(3 * a), column) = Vector(n.x, n.y, n.z);
    }
  }
  return h.colPivHouseholderQr().rank();
}

TEST_CASE("a bed at exact rest balances to 1e-10 m g, and its forces are positive and unique") {
  PackingSpec two_sizes = small_spec({4, 4, periodic, walls}, 150, 3);
  two_sizes.sizes.small_share = 0.4;
  for (const PackingSpec& spec :
       {small_spec({4, 4, periodic, walls}, 120, 1), small_spec({4, 4, periodic, periodic}, 120, 2),
        small_spec({4, 4, walls, walls}, 120, 4), two_sizes}) {
    std::vector<ForceContact> contacts;
    SphereBed bed = settled_bed(spec, contacts);
    const ExactRest rest = rest_exactly(testing::kernels(), contacts, bed);
    REQUIRE(rest.failure == "");
    check_certificate(bed, rest);
    const auto held = static_cast<std::int64_t>(3 * bed.grains()) - zero_modes(bed, rest.contacts);
    CHECK(static_cast<std::int64_t>(rest.contacts.size()) == held);
    CHECK(rank_of(bed, rest.contacts) == held);
  }
}

TEST_CASE("a tower whose forces are fifty weights comes to exact rest with closed gaps") {
  std::vector<ForceContact> contacts;
  SphereBed bed = settled_bed(small_spec({2.5, 2.5, periodic, walls}, 300, 9), contacts);
  const ExactRest rest = rest_exactly(testing::kernels(), contacts, bed);
  REQUIRE(rest.failure == "");
  check_certificate(bed, rest);
  double largest = 0.0;
  for (const ForceContact& contact : rest.contacts) {
    largest = std::max(largest, contact.force);
    // Newton steps close gaps to the rounding of coordinates up to 50 d: 7e-15 d, some of each.
    if (bed.is_grain(contact.b)) {
      CHECK(std::abs(testing::gap_of(bed, contact.a, contact.b)) < 1e-13);
    }
  }
  CHECK(largest > 50.0);
}

TEST_CASE("a bed in a round tube comes to exact rest") {
  std::vector<ForceContact> contacts;
  SphereBed bed = settled_bed(small_spec(tube_of(3.4), 80, 5), contacts);
  const ExactRest rest = rest_exactly(testing::kernels(), contacts, bed);
  REQUIRE(rest.failure == "");
  check_certificate(bed, rest);
}

/// With the curvature of pairs the last rounds are Newton's, and square what is left. Without it
/// they leave 1e-12 m g of these beds, more than 1e-10 of one of 160 larger ones, and do not tell
/// beds that would roll away from those that rest.
TEST_CASE("forces of beds in tubes are found to the last digits") {
  for (const std::uint64_t seed : {12U, 43U}) {
    INFO("seed " << seed);
    std::vector<ForceContact> contacts;
    SphereBed bed = settled_bed(small_spec(tube_of(7), 500, seed), contacts);
    const ExactRest rest = rest_exactly(testing::kernels(), contacts, bed);
    REQUIRE(rest.failure == "");
    CHECK(rest.imbalance < 2e-13);  // sums of some 100 m g have as many digits
  }
}

TEST_CASE("exact rest has the same bits on all instruction sets") {
  std::vector<ForceContact> contacts;
  const SphereBed settled = settled_bed(small_spec({4, 4, periodic, walls}, 120, 6), contacts);
  std::set<std::uint64_t> states;
  for (const Isa isa : testing::testable_isas()) {
    SphereBed bed = settled;
    CHECK(rest_exactly(kernels_for(isa), contacts, bed).failure == "");
    states.insert(state_hash(bed));
  }
  CHECK(states.size() == 1);
}

TEST_CASE("a grain that leans on another in a shaft pushes as its place says") {
  // In opposite corners; their centres are 1 apart, half of it squared upwards.
  const double upper = 0.5 + std::sqrt(0.5);
  SphereBed bed = make_bed({1.5, 1.5, walls, walls},
                           {{0.501, 0.502, 0.5, 0.5}, {0.998, 1.0, upper + 1e-3, 0.5}});
  const ExactRest rest = rest_exactly(testing::kernels(), {}, bed);
  REQUIRE(rest.failure == "");
  check_certificate(bed, rest);
  CHECK(bed.position[1].z == about(upper, 1e-11));
  REQUIRE(rest.contacts.size() == 6);
  double floor = 0.0, sides = 0.0, pair = 0.0;
  for (const ForceContact& contact : rest.contacts) {
    (bed.is_grain(contact.b)         ? pair
     : contact.b == bed.wall_name(0) ? floor
                                     : sides) += contact.force;
  }
  CHECK(floor == Approx(2.0).epsilon(1e-10));
  CHECK(pair == Approx(std::sqrt(2.0)).epsilon(1e-10));
  CHECK(sides == Approx(4.0 * std::sqrt(0.5)).epsilon(1e-10));  // two walls on each grain
}

TEST_CASE(
    "grains that float come down to the floor as long as they sink, or are not said to rest") {
  // By at most 0.03 d in each round.
  const auto dropped_from = [](double z) {
    return make_bed({4, 4, periodic, walls}, {{2, 2, z, 0.5}, {2.2, 2, z + 1.0, 0.5}});
  };
  for (const double height : {5.0, 40.0}) {
    SphereBed bed = dropped_from(height);
    const ExactRest rest = rest_exactly(testing::kernels(), {}, bed);
    REQUIRE(rest.failure == "");
    CHECK(rest.rounds > (height - 1.0) / 0.03);
    check_certificate(bed, rest);
  }
  SphereBed high = dropped_from(150.0);
  const ExactRest rest = rest_exactly(testing::kernels(), {}, high);
  CHECK(rest.failure == "no state without motion was found in time");
  CHECK(rest.rounds == 3600);
}

TEST_CASE("the search for exact rest stops when it is asked to") {
  std::vector<ForceContact> contacts;
  SphereBed bed = settled_bed(small_spec({4, 4, periodic, walls}, 60, 7), contacts);
  int rounds = 0;
  const ExactRest rest =
      rest_exactly(testing::kernels(), contacts, bed,
                   {.keep_going = [&](const SaveSearch&) { return ++rounds < 5; }});
  CHECK(rest.failure == "cancelled");
  CHECK(rest.rounds == 4);
}

TEST_CASE("a search for exact rest that was stopped goes on with the same bits") {
  const Box box = GENERATE(Box{4, 4, periodic, walls}, tube_of(2.5));
  std::vector<ForceContact> contacts;
  const SphereBed settled = settled_bed(small_spec(box, 90, 7), contacts);
  SphereBed at_once = settled;
  const ExactRest whole = rest_exactly(testing::kernels(), contacts, at_once);
  REQUIRE(whole.failure == "");
  for (const int stop : {1, 7, whole.rounds}) {
    std::string saved;
    int asked = 0;
    SphereBed stopped = settled;
    const ExactRest part =
        rest_exactly(testing::kernels(), contacts, stopped, {[&](const SaveSearch& save) {
                       saved = save();
                       return ++asked < stop;
                     }});
    CHECK(part.failure == "cancelled");
    SphereBed bed = settled;
    const ExactRest rest = rest_exactly(testing::kernels(), contacts, bed, {.saved = saved});
    CHECK(rest.failure == "");
    CHECK(rest.rounds == whole.rounds);
    for (std::size_t i = 0; i < bed.grains(); ++i) {
      CHECK(bed.position[i].x == at_once.position[i].x);
      CHECK(bed.position[i].z == at_once.position[i].z);
    }
    REQUIRE(rest.contacts.size() == whole.contacts.size());
    for (std::size_t k = 0; k < rest.contacts.size(); ++k) {
      CHECK(rest.contacts[k].force == whole.contacts[k].force);
    }
  }
}

TEST_CASE(
    "a search that is stopped while it looks whether the bed still sinks goes on with the same "
    "bits") {
  // Sinks for more than 600 rounds, after each of which it is looked at.
  const SphereBed dropped =
      make_bed({4, 4, periodic, walls}, {{2, 2, 40, 0.5}, {2.2, 2, 41.0, 0.5}});
  SphereBed at_once = dropped;
  std::vector<std::string> saved;
  const ExactRest whole = rest_exactly(testing::kernels(), {}, at_once,
                                       {.keep_going =
                                            [&](const SaveSearch& save) {
                                              saved.push_back(save());
                                              return true;
                                            },
                                        .asked_after = 0.0});
  REQUIRE(whole.failure == "");
  const std::size_t asks = saved.size() / static_cast<std::size_t>(whole.rounds);
  REQUIRE(asks > 1);  // within each round, too
  for (std::size_t k = 599 * asks; k < 602 * asks; ++k) {
    SphereBed bed = dropped;
    const ExactRest rest = rest_exactly(testing::kernels(), {}, bed, {.saved = saved[k]});
    CHECK(rest.failure == "");
    CHECK(rest.rounds == whole.rounds);
    CHECK(state_hash(bed) == state_hash(at_once));
  }
}

TEST_CASE("the accuracy exact settles beds with isostatic contacts, near where they were settled") {
  PackingSpec spec = small_spec({4, 4, periodic, walls}, 120, 8);
  spec.accuracy = *preset("exact");
  Accuracy in_steps = spec.accuracy;
  in_steps.rest = Rest::in_steps;
  SphereBed before = start<Sphere>(spec).value(), bed = before;
  settle(in_steps, testing::kernels(), before, always);
  const SettleReport report = settle(spec.accuracy, testing::kernels(), bed, always);
  REQUIRE(report.failure == "");
  CHECK(report.rest.contacts == report.rest.isostatic_contacts);
  CHECK(report.rest.imbalance.max < exact_imbalance);
  CHECK(report.rest.overlap_max < exact_overlap);
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    const Record<double>&p = bed.position[i], &q = before.position[i];
    CHECK(std::abs(p.z - q.z) < 0.1);  // no grain has left its place
  }
  CHECK(report.force.size() == bed.grains());
}

/// Grains of such files have two contacts each, and touch some of the next but one: of 24 starts
/// none came to exact rest as long as products were driven down while forces were far from
/// balanced.
TEST_CASE("single files that only the round wall's curvature holds come to exact rest") {
  for (const double diameter : {1.7, 1.76, 1.84}) {
    PackingSpec spec = small_spec(tube_of(diameter), 100, 3);
    spec.accuracy.rest = Rest::exact;
    SphereBed bed = start<Sphere>(spec).value();
    const SettleReport report = settle(spec.accuracy, testing::kernels(), bed, always);
    CHECK(report.failure == "");
    CHECK(report.rest.contacts < report.rest.isostatic_contacts);
    CHECK(report.rest.imbalance.max < exact_imbalance);
    CHECK(report.rest.overlap_max < exact_overlap);
  }
}

/// Layers of three fit into this tube by 0.001 d: they wedge, and steps leave forces that grow and
/// shrink without end.
PackingSpec wedged_spec() {
  PackingSpec spec = small_spec(tube_of(2.1525), 60, 2);
  spec.sizes.spread = 0.0;
  spec.accuracy = *preset("fast");
  return spec;
}

TEST_CASE("a small bed of spheres that steps do not bring to rest is brought to exact rest") {
  const PackingSpec spec = wedged_spec();
  SphereBed bed = start<Sphere>(spec).value();
  const SettleReport report = settle(spec.accuracy, testing::kernels(), bed, always);
  REQUIRE(report.failure == "");
  CHECK(report.rest.imbalance.max < exact_imbalance);
  CHECK(report.rest.overlap_max < exact_overlap);
  CHECK(report.rest.contacts + report.rest.held_by_turning >= report.rest.isostatic_contacts);
  CHECK(report.rest.independent_contacts <= static_cast<double>(report.rest.isostatic_contacts));
}

TEST_CASE("equal spheres on more contacts than hold them are not at exact rest, unlike ones are") {
  PackingSpec spec = small_spec({4, 1.5, periodic, walls}, 100, 1);
  spec.accuracy.rest = Rest::exact;
  int too_many = 0;
  for (spec.random_key = 1; spec.random_key <= 4; ++spec.random_key) {
    spec.sizes.spread = 0.0;
    SphereBed equal = start<Sphere>(spec).value();
    const SettleReport report = settle(spec.accuracy, testing::kernels(), equal, always);
    CHECK((report.failure != "" || report.rest.contacts == report.rest.isostatic_contacts));
    if (report.failure.find("more contacts bear it than hold it") != std::string::npos) {
      ++too_many;
      CHECK_THAT(report.failure, Catch::EndsWith("; give sizes a spread, as of 1e-3, or "
                                                 "accuracy.rest in_steps"));
    }
    spec.sizes.spread = 1e-3;
    SphereBed unlike = start<Sphere>(spec).value();
    const SettleReport exact = settle(spec.accuracy, testing::kernels(), unlike, always);
    CHECK(exact.failure == "");
    CHECK(exact.rest.contacts == exact.rest.isostatic_contacts);
  }
  CHECK(too_many > 0);
}

/// A bed that is stopped when its observer is asked for the `last` time, and another one that goes
/// on from the bytes saved then.
SettleReport settle_stopped(const Accuracy& accuracy, std::int64_t last, SphereBed first,
                            SphereBed& other) {
  std::string saved;
  std::int64_t asked = 0;
  settle(accuracy, testing::kernels(), first, [&](const Progress& progress) {
    if (++asked == last) saved = progress.save();
    return asked < last;
  });
  REQUIRE_FALSE(saved.empty());
  return settle(accuracy, testing::kernels(), other, always, saved);
}

/// Stops a bed so many questions before its end, in searches for exact rest or before.
void check_stopped(const Accuracy& accuracy, const SphereBed& bed,
                   const std::vector<std::int64_t>& before_end) {
  SphereBed whole = bed;
  std::int64_t asked = 0;
  const SettleReport expected = settle(accuracy, testing::kernels(), whole,
                                       [&](const Progress& /*progress*/) { return ++asked > 0; });
  for (const std::int64_t before : before_end) {
    INFO("stopped " << before << " questions before the end of " << asked);
    SphereBed other = bed;
    const SettleReport report = settle_stopped(accuracy, asked - before, bed, other);
    CHECK(report.failure == expected.failure);
    CHECK(state_hash(other) == state_hash(whole));
    CHECK(report.force == expected.force);
    CHECK(report.steps == expected.steps);
    CHECK(report.iterations == expected.iterations);
    CHECK(report.rest.imbalance.max == expected.rest.imbalance.max);
  }
}

TEST_CASE("a bed that is stopped on its way to exact rest goes on to the same bits") {
  const PackingSpec spec = small_spec({4, 4, periodic, walls}, 120, 8);
  check_stopped(*preset("exact"), start<Sphere>(spec).value(), {1, 9, 200});
  const PackingSpec wedged = wedged_spec();
  check_stopped(wedged.accuracy, start<Sphere>(wedged).value(), {1, 9, 200});
}

TEST_CASE("a bed that is stopped between searches in vain for exact rest goes on to the same end") {
  // A row that its box just holds rests in steps, where its grains do not push each other.
  const SphereBed row =
      make_bed({4, 4, walls, walls},
               {{0.5, 2, 0.5, 0.5}, {1.5, 2, 0.5, 0.5}, {2.5, 2, 0.5, 0.5}, {3.5, 2, 0.5, 0.5}});
  SphereBed bed = row;
  std::vector<std::int64_t> steps;  // before each question; none lies between those of a search
  const SettleReport report =
      settle(*preset("exact"), testing::kernels(), bed, [&](const Progress& progress) {
        steps.push_back(progress.step);
        return true;
      });
  CHECK(report.failure.starts_with("at rest in steps, but exact rest was not found"));
  std::vector<std::int64_t> searches;  // their first questions, counted from the end
  for (std::size_t k = 1; k < steps.size(); ++k) {
    const bool is_first = steps[k] == steps[k - 1] && (k == 1 || steps[k - 1] != steps[k - 2]);
    if (is_first) searches.push_back(static_cast<std::int64_t>(steps.size() - 1 - k));
  }
  REQUIRE(searches.size() == 3);
  check_stopped(*preset("exact"), row, searches);
  check_stopped(*preset("exact"), row, {searches.back() + 40});  // in the steps between
}

TEST_CASE("grains that stand by symmetry alone are not said to rest") {
  PackingSpec spec = small_spec({4, 4, walls, walls}, 2, 1);
  SphereBed bed = make_bed(spec.box, {{2, 2, 0.5, 0.5}, {2, 2, 1.5, 0.5}});
  spec.accuracy = *preset("exact");
  CHECK(settle(spec.accuracy, testing::kernels(), bed, always).failure != "");
}

}  // namespace
}  // namespace grainsweep
