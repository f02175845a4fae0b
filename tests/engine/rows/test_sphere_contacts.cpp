#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <catch2/catch.hpp>

#include "engine/rows/sphere_contacts.hpp"
#include "tests/support/about.hpp"
#include "tests/support/brute_force.hpp"
#include "tests/support/draw.hpp"
#include "tests/support/instruction_sets.hpp"
#include "tests/support/named_contacts.hpp"
#include "tests/support/scenes.hpp"

namespace grainsweep {
namespace {

using testing::Draw;
using testing::impulses_of;
using testing::kernels;
using testing::periodic;
using testing::visit_named;
using testing::walls;

using Name = testing::ContactName;

std::set<Name> names_of(const SphereBed& bed, const Candidates& candidates) {
  std::set<Name> names = testing::listed_pairs(candidates);
  for (std::size_t k = 0; k < candidates.walls.size(); ++k) {
    for (const std::int32_t grain : candidates.walls[k]) {
      names.insert({grain, bed.wall() + static_cast<std::int32_t>(k)});
    }
  }
  return names;
}

/// No lane of a block names a grain that another lane names; the rest are void and without impulse.
template <class Real>
void expect_independent_lanes(const SphereBed& bed, const SphereContacts<Real>& contacts) {
  for (std::size_t block = 0; block < contacts.rows.size(); ++block) {
    std::set<std::int32_t> seen;
    for (std::size_t lane = 0; lane < block_width; ++lane) {
      const std::int32_t a = contacts.rows[block].a(lane), b = contacts.rows[block].b(lane);
      if (a == bed.void_a()) {
        REQUIRE(b == bed.void_b());
        REQUIRE(contacts.impulse[block * block_width + lane] == 0);
        continue;
      }
      REQUIRE(seen.insert(a).second);
      REQUIRE((block < contacts.pair_blocks ? seen.insert(b).second : b == bed.wall()));
    }
    REQUIRE_FALSE(seen.empty());
  }
}

template <class Real>
void expect_right_layout(const SphereBed& bed, const Candidates& candidates,
                         const SphereContacts<Real>& contacts) {
  REQUIRE(contacts.impulse.size() == contacts.rows.size() * block_width);
  expect_independent_lanes(bed, contacts);
  std::set<Name> laid_out;
  visit_named(bed, contacts, [&](const Name& name, std::size_t, std::size_t) {
    REQUIRE(laid_out.insert(name).second);
  });
  CHECK(laid_out == names_of(bed, candidates));
}

Candidates candidates_within(double distance, SphereBed& bed) {
  Candidates candidates;
  wrap(bed);
  find_candidates({bed, bed.position}, distance, kernels(), candidates);
  return candidates;
}

SphereBed dense_bed(std::size_t grains, std::uint64_t seed) {
  return testing::random_bed({{4, 4, walls, walls}, grains, 0.4, 0.5, 4, seed});
}

TEMPLATE_TEST_CASE("every candidate is laid out once, and lanes of a block share no grain", "",
                   float, double) {
  for (const std::size_t grains : {0U, 1U, 2U, 17U, 60U, 250U}) {
    INFO(grains << " grains");
    SphereBed bed = dense_bed(grains, grains);
    const Candidates candidates = candidates_within(0.3, bed);
    SphereContacts<TestType> contacts;
    lay_out(bed, candidates, contacts);
    expect_right_layout(bed, candidates, contacts);
  }
}

TEST_CASE("blocks of a dense bed are nearly full") {
  SphereBed bed = testing::fcc_bed(4, 4, 6);
  const Candidates candidates = candidates_within(0.05, bed);
  SphereContacts<float> contacts;
  lay_out(bed, candidates, contacts);
  const auto lanes = static_cast<double>(contacts.pair_blocks * block_width);
  CHECK(static_cast<double>(candidates.pairs.size()) / lanes > 0.9);
}

TEMPLATE_TEST_CASE("a grain may have more contacts than there are open blocks", "", float, double) {
  Draw draw(2);
  std::vector<PlacedSphere> spheres = {{10, 10, 10, 2.0}};
  for (int k = 0; k < 300; ++k) {
    const Draw::Direction n = draw.direction();
    spheres.push_back({10 + 2.1 * n.x, 10 + 2.1 * n.y, 10 + 2.1 * n.z, 0.1});
  }
  SphereBed bed = make_bed({20, 20, periodic, walls}, spheres);
  const Candidates candidates = candidates_within(0.01, bed);
  SphereContacts<TestType> contacts;
  lay_out(bed, candidates, contacts);
  CHECK(contacts.pair_blocks >= 300);
  expect_right_layout(bed, candidates, contacts);
}

/// A positive number of its own for each contact, exact in f32; some contacts do not push.
template <class Real>
Real impulse_named(const Name& name) {
  return static_cast<Real>(name.first % 5 == 0 ? 0 : name.first * 1024 + name.second);
}

TEMPLATE_TEST_CASE("contacts keep their impulse in a new list, others start without", "", float,
                   double) {
  SphereBed bed = dense_bed(120, 5);
  SphereContacts<TestType> contacts;
  const Candidates before = candidates_within(0.2, bed);
  lay_out(bed, before, contacts);
  visit_named(bed, contacts, [&](const Name& name, std::size_t block, std::size_t lane) {
    contacts.impulse[block * block_width + lane] = impulse_named<TestType>(name);
  });
  Draw draw(6);
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    bed.position[i].x += draw.uniform(-0.2, 0.2);
    bed.position[i].z += draw.uniform(-0.2, 0.2);
  }
  const Candidates after = candidates_within(0.2, bed);
  lay_out(bed, after, contacts);
  expect_right_layout(bed, after, contacts);
  const std::set<Name> old_names = names_of(bed, before);
  int kept = 0, fresh = 0;
  for (const auto& [name, impulse] : impulses_of(bed, contacts)) {
    const bool was_there = old_names.count(name) == 1;
    REQUIRE(impulse == (was_there ? impulse_named<TestType>(name) : TestType(0)));
    (was_there ? kept : fresh) += 1;
  }
  CHECK(kept > 300);
  CHECK(fresh > 30);
}

TEMPLATE_TEST_CASE("a grain in a corner keeps the impulse of each of its walls", "", float,
                   double) {
  SphereBed bed = make_bed({4, 4, walls, walls}, {{0.5, 0.5, 0.5, 0.5}, {3.5, 3.5, 0.5, 0.5}});
  const Candidates candidates = candidates_within(0.1, bed);
  SphereContacts<TestType> contacts;
  lay_out(bed, candidates, contacts);
  visit_named(bed, contacts, [&](const Name& name, std::size_t block, std::size_t lane) {
    contacts.impulse[block * block_width + lane] =
        static_cast<TestType>(name.first * 10 + name.second);
  });
  lay_out(bed, candidates, contacts);
  const std::map<Name, TestType> expected = {{{0, 2}, TestType(2)},  {{0, 3}, TestType(3)},
                                             {{0, 5}, TestType(5)},  {{1, 2}, TestType(12)},
                                             {{1, 4}, TestType(14)}, {{1, 6}, TestType(16)}};
  CHECK(impulses_of(bed, contacts) == expected);
}

// A round wall has two rows, of the parts of its push along x and y, and closed one, across it.
TEST_CASE("a closed contact with a round wall takes over what both of its rows push") {
  SphereBed bed = make_bed(tube_of(3), {{1.5 + 0.6, 1.5 + 0.8, 2, 0.5}});
  const Candidates candidates = candidates_within(0.1, bed);
  SphereContacts<double> contacts, closed;
  lay_out(bed, candidates, contacts);
  visit_named(bed, contacts, [&](const Name&, std::size_t block, std::size_t lane) {
    contacts.impulse[block * block_width + lane] = block == contacts.first_round ? 3.0 : 4.0;
  });
  lay_out_closed(0.01, kernels(), bed, candidates, 0.5, contacts, closed);
  const std::map<Name, double> expected = {{{0, testing::wall_name(bed, 1)}, 5.0 / (0.5 * 0.5)}};
  CHECK(impulses_of(bed, closed) == expected);
}

TEMPLATE_TEST_CASE("rows have the gap and the unit normal of their contact", "", float, double) {
  const double rounding = std::is_same_v<TestType, float> ? 1e-6 : 1e-14;
  SphereBed bed = testing::random_bed({{4, 3, periodic, walls}, 100, 0.2, 0.5, 4, 9});
  const Candidates candidates = candidates_within(0.3, bed);
  SphereContacts<TestType> contacts;
  lay_out(bed, candidates, contacts);
  update_gaps(bed, kernels(), 1.0, contacts);
  visit_named(bed, contacts, [&](const Name& name, std::size_t block, std::size_t lane) {
    const RowBlock<TestType>& r = contacts.rows[block];
    const auto a = static_cast<std::size_t>(name.first), b = static_cast<std::size_t>(name.second);
    const double x = static_cast<double>(r.normal_x[lane]);
    const double y = static_cast<double>(r.normal_y[lane]);
    const double z = static_cast<double>(r.normal_z[lane]);
    CHECK(std::hypot(x, y, z) == about(1, rounding));
    const bool is_pair = name.second < bed.wall();
    const double gap = is_pair ? testing::gap_of(bed, name.first, name.second)
                               : bed.walls[b - bed.grains()].gap(bed.position[a]);
    CHECK(static_cast<double>(r.gap[lane]) == about(gap, rounding));
    // Moving a by h along the normal, towards b, closes the gap by h.
    const double h = 1e-3;
    SphereBed moved = bed;
    moved.position[a].x += h * x;
    moved.position[a].y += h * y;
    moved.position[a].z += h * z;
    const double closed = is_pair ? testing::gap_of(moved, name.first, name.second)
                                  : bed.walls[b - bed.grains()].gap(moved.position[a]);
    CHECK(closed == about(gap - h, rounding));
  });
}

TEMPLATE_TEST_CASE("a step repairs the share of an overlap that it is told to", "", float, double) {
  SphereBed bed =
      make_bed({4, 4, periodic, walls}, {{2, 2, 0.25, 0.5}, {2, 2, 1, 0.5}, {2, 2, 2.0625, 0.5}});
  const Candidates candidates = candidates_within(0.5, bed);
  SphereContacts<TestType> contacts;
  lay_out(bed, candidates, contacts);
  update_gaps(bed, kernels(), 0.5, contacts);
  std::map<Name, TestType> gaps;
  visit_named(bed, contacts, [&](const Name& name, std::size_t block, std::size_t lane) {
    gaps[name] = contacts.rows[block].gap[lane];
  });
  CHECK(gaps.at({0, 3}) == TestType(-0.125));  // the floor, -.25 deep
  CHECK(gaps.at({0, 1}) == TestType(-0.125));
  CHECK(gaps.at({1, 2}) == TestType(0.0625));  // a gap stays what it is
}

TEMPLATE_TEST_CASE("unused lanes have a positive gap and cannot push", "", float, double) {
  SphereBed bed = make_bed({4, 4, walls, walls}, {{0.5, 0.5, 0.5, 0.5}, {1.5, 0.5, 0.5, 0.5}});
  const Candidates candidates = candidates_within(0.1, bed);
  SphereContacts<TestType> contacts;
  lay_out(bed, candidates, contacts);
  update_gaps(bed, kernels(), 1.0, contacts);
  int unused = 0;
  for (const RowBlock<TestType>& block : contacts.rows) {
    for (std::size_t lane = 0; lane < block_width; ++lane) {
      if (block.a(lane) == bed.void_a()) {
        CHECK(block.gap[lane] > 0);
        ++unused;
      }
    }
  }
  CHECK(unused == 15 + 14 + 15 + 14);  // the pair, the floor, x = 0, y = 0
}

TEST_CASE("rows are visited without the unused ones, each with its impulse") {
  SphereBed bed = make_bed({4, 4, walls, walls}, {{0.5, 0.5, 0.5, 0.5}, {1.5, 0.5, 0.5, 0.5}});
  const Candidates candidates = candidates_within(0.1, bed);
  SphereContacts<double> contacts;
  lay_out(bed, candidates, contacts);
  std::fill(contacts.impulse.begin(), contacts.impulse.end(), 0.25);
  int rows = 0;
  testing::visit_rows(bed, contacts,
                      [&](const RowBlock<double>& r, std::size_t lane, double impulse) {
                        CHECK(r.a(lane) < bed.wall());
                        CHECK(impulse == 0.25);
                        ++rows;
                      });
  CHECK(rows == 6);
}

}  // namespace
}  // namespace grainsweep
