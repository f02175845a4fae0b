#include <map>
#include <set>

#include <catch2/catch.hpp>

#include "engine/rows/late_rows.hpp"
#include "tests/support/brute_force.hpp"
#include "tests/support/draw.hpp"
#include "tests/support/instruction_sets.hpp"
#include "tests/support/named_contacts.hpp"
#include "tests/support/scenes.hpp"

namespace grainsweep {
namespace late_rows_test {

using testing::Draw;
using testing::kernels;
using testing::NamedPair;
using testing::periodic;
using testing::walls;

constexpr double near = 0.05, margin = 0.01;  // d

/// What the rows of a bed have gone through.
struct Counts {
  int layouts = 0;  ///< searches, and the layouts between them
  int late = 0;     ///< steps that added rows without a layout
};

/// Blocks of all subdomains that hold late rows, and that are free for them.
template <class Real>
std::size_t late_blocks(const SphereContacts<Real>& contacts) {
  std::size_t blocks = 0;
  for (const LateBlocks& late : contacts.late) {
    const BlockRange& range = contacts.shares.ranges[late.range];
    blocks += range.first + range.blocks - late.first;
  }
  return blocks;
}
template <class Real>
std::size_t free_blocks(const SphereContacts<Real>& contacts) {
  std::size_t blocks = 0;
  for (const LateBlocks& late : contacts.late) blocks += late.end - late.first;
  return blocks - late_blocks(contacts);
}

/// Brings the rows to where the grains are, as a step does.
template <class Real>
void bring_up_to_date(SphereBed& bed, Candidates& candidates, SphereContacts<Real>& contacts,
                      Counts& counts) {
  const std::size_t late_before = late_blocks(contacts), free_before = free_blocks(contacts);
  const bool searched = renew_rows(near, near + margin, kernels(), bed, candidates, contacts);
  counts.layouts += searched || late_blocks(contacts) < late_before ? 1 : 0;
  counts.late += free_blocks(contacts) < free_before ? 1 : 0;
}

/// Every pair and wall with a gap below `near` is a row that is swept, none twice, and no block
/// holds a grain twice.
template <class Real>
void expect_all_near(const SphereBed& bed, const SphereContacts<Real>& contacts) {
  std::vector<bool> is_swept(contacts.rows.size(), false);
  for (const BlockRange& range : contacts.shares.ranges) {
    for (std::size_t k = range.first; k < range.first + range.blocks; ++k) is_swept[k] = true;
  }
  std::set<NamedPair> rows;
  std::map<std::size_t, std::set<std::int32_t>> grains;
  testing::visit_named(bed, contacts, [&](const NamedPair& name, std::size_t block, std::size_t) {
    REQUIRE(is_swept[block]);
    REQUIRE(rows.insert(name).second);
    REQUIRE(grains[block].insert(name.first).second);
    if (bed.is_grain(name.second)) REQUIRE(grains[block].insert(name.second).second);
  });
  for (const NamedPair& pair : testing::pairs_closer_than(bed, near)) {
    INFO("grains " << pair.first << " and " << pair.second);
    REQUIRE(rows.count(pair) == 1);
  }
  for (std::size_t k = 0; k < bed.walls.size(); ++k) {
    for (std::size_t i = 0; i < bed.grains(); ++i) {
      if (bed.walls[k].gap(bed.position[i]) < near) {
        REQUIRE(rows.count({static_cast<std::int32_t>(i), testing::wall_name(bed, k)}) == 1);
      }
    }
  }
}

/// Most grains jitter, some stray.
void move(SphereBed& bed, Draw& draw) {
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    const Draw::Direction n = draw.direction();
    const double way = i % 25 == 3 ? 0.03 : 0.003;
    bed.position[i].x += way * n.x;
    bed.position[i].y += way * n.y;
    bed.position[i].z += way * n.z;
  }
}

TEMPLATE_TEST_CASE("whatever has come near is a row, step after step", "", float, double) {
  for (const Box& box :
       {Box{8, 5, periodic, walls}, Box{4, 6, periodic, periodic}, Box{5, 5, walls, walls}}) {
    for (const double small : {0.45, 0.2}) {
      INFO(box.length << " x " << box.width << ", smallest radius " << small);
      SphereBed bed = testing::random_bed({box, 300, small, 0.5, 5, 4});
      Candidates candidates;
      SphereContacts<TestType> contacts;
      Counts counts;
      Draw draw(9);
      for (int step = 0; step < 40; ++step) {
        bring_up_to_date(bed, candidates, contacts, counts);
        expect_all_near(bed, contacts);
        move(bed, draw);
      }
      CHECK(counts.late > 0);
    }
  }
}

/// A bed of several subdomains.
SphereBed large_bed() {
  return testing::random_bed({{20, 10, periodic, walls}, 16'000, 0.45, 0.5, 80, 3});
}

TEST_CASE("late rows of a large bed stay in the subdomains that may hold them") {
  SphereBed bed = large_bed();
  Candidates candidates;
  SphereContacts<float> contacts;
  Counts counts;
  Draw draw(9);
  for (int step = 0; step < 6; ++step) {
    bring_up_to_date(bed, candidates, contacts, counts);
    move(bed, draw);
  }
  REQUIRE(contacts.shares.phases() == 2);
  CHECK(counts.layouts < 6);
  const Subdomains& all = contacts.layout.subdomains;
  for (std::size_t k = 0; k < all.count; ++k) {
    const LateBlocks& late = contacts.late[k];
    const BlockRange& range = contacts.shares.ranges[late.range];
    CHECK(range.first + range.blocks <= late.end);
    for (std::size_t block = range.first; block < late.end; ++block) {
      for (std::size_t lane = 0; lane < block_width; ++lane) {
        const GrainPair pair{contacts.rows[block].a(lane), contacts.rows[block].b(lane)};
        if (bed.is_void(pair.a)) continue;
        REQUIRE(all.may_hold(pair));
        REQUIRE(all.subdomain_of(pair) == k);
      }
    }
  }
}

TEST_CASE("a pair of grains that were looked up beyond each other's next subdomain is a spare") {
  SphereBed bed = large_bed();
  Candidates candidates;
  SphereContacts<float> contacts;
  Counts counts;
  bring_up_to_date(bed, candidates, contacts, counts);
  const Subdomains& all = contacts.layout.subdomains;
  REQUIRE(all.count > 2);
  const std::int32_t low = all.grains.front(), high = all.grains.back();
  bed.position[static_cast<std::size_t>(high)] = bed.position[static_cast<std::size_t>(low)];
  const std::size_t before = contacts.layout.near.size() + contacts.spares.count;
  candidates.pairs.push_back({std::min(low, high), std::max(low, high)});
  part_spares(near + margin, kernels(), bed, candidates, contacts);
  CHECK(contacts.layout.near.size() + contacts.spares.count == before + 1);
  for (const GrainPair pair : contacts.layout.near) REQUIRE(all.may_hold(pair));
}

TEST_CASE("a row keeps its impulse while others are added") {
  SphereBed bed =
      make_bed({6, 6, walls, walls},
               {{1, 1, 0.5, 0.5}, {2, 1, 0.5, 0.5}, {3.12, 1, 0.5, 0.5}, {3, 3, 0.5, 0.5}});
  Candidates candidates;
  SphereContacts<double> contacts;
  Counts counts;
  bring_up_to_date(bed, candidates, contacts, counts);
  testing::set_impulses<double>(bed, {{{0, 1}, 7.0}}, contacts);
  CHECK(testing::impulses_of(bed, contacts).count({1, 2}) == 0);
  bed.position[2].x = 3.04;
  bring_up_to_date(bed, candidates, contacts, counts);
  CHECK(counts.layouts == 1);
  CHECK(testing::impulses_of(bed, contacts).at({0, 1}) == 7.0);
  CHECK(testing::impulses_of(bed, contacts).at({1, 2}) == 0.0);
}

}  // namespace late_rows_test
}  // namespace grainsweep
