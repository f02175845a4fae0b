#include <algorithm>
#include <set>
#include <utility>

#include <catch2/catch.hpp>

#include "engine/rows/sphere_contacts.hpp"
#include "engine/rows/subdomains.hpp"
#include "tests/support/instruction_sets.hpp"
#include "tests/support/part_loops.hpp"
#include "tests/support/scenes.hpp"

namespace grainsweep {
namespace {

using testing::kernels;

/// A bed of `grains` about as dense as a packing that falls.
SphereBed tall_bed(std::size_t grains, Boundary y) {
  testing::RandomScene scene;
  scene.box = {20, 10, Boundary::periodic, y};
  scene.grains = grains;
  scene.height = static_cast<double>(grains) / 200.0;
  scene.min_radius = 0.25;
  return testing::random_bed(scene);
}

/// A bed three grains high: its subdomains follow one another along x.
SphereBed flat_bed(Boundary x, std::size_t grains = 30'000) {
  testing::RandomScene scene;
  scene.box = {120, 60, x, Boundary::periodic};
  scene.grains = grains;
  scene.height = 3.0;
  scene.min_radius = 0.25;
  return testing::random_bed(scene);
}

std::vector<SphereBed> large_beds() {
  return {tall_bed(16'000, Boundary::periodic), tall_bed(21'000, Boundary::walls),
          tall_bed(30'000, Boundary::periodic), flat_bed(Boundary::walls),
          flat_bed(Boundary::periodic),         flat_bed(Boundary::periodic, 26'000)};
}

Candidates candidates_of(SphereBed& bed) {
  Candidates candidates;
  wrap(bed);
  find_candidates({bed, bed.position}, 0.1, kernels(), candidates);
  return candidates;
}

void divide(const SphereBed& bed, const Candidates& candidates, const ParallelFor& loop,
            Subdomains& subdomains) {
  divide_grains(bed, Sphere::subdomain_grains, candidates, loop, subdomains);
  divide_pairs(candidates.pairs, loop, subdomains);
}

std::vector<std::pair<std::int32_t, std::int32_t>> sorted(const std::vector<GrainPair>& pairs) {
  std::vector<std::pair<std::int32_t, std::int32_t>> names;
  for (const GrainPair pair : pairs) names.emplace_back(pair.a, pair.b);
  std::sort(names.begin(), names.end());
  return names;
}

TEST_CASE("a grain belongs where it was looked up, wherever it has gone since") {
  SphereBed bed = flat_bed(Boundary::periodic);
  const Candidates candidates = candidates_of(bed);
  Subdomains before, after;
  divide(bed, candidates, serial_for, before);
  REQUIRE(before.count > 1);
  for (std::size_t i = 0; i < bed.grains(); ++i) bed.position[i].x -= 0.04;  // some leave the box
  divide(bed, candidates, serial_for, after);
  CHECK(before.slab == after.slab);
  CHECK(before.begin == after.begin);
}

TEST_CASE("a small bed is one subdomain, with its pairs as they are") {
  SphereBed bed = tall_bed(2000, Boundary::walls);
  const Candidates candidates = candidates_of(bed);
  Subdomains subdomains;
  divide(bed, candidates, serial_for, subdomains);
  CHECK(subdomains.count == 1);
  CHECK(subdomains.begin == std::vector<std::size_t>{0, candidates.pairs.size()});
  CHECK(std::equal(subdomains.pairs.begin(), subdomains.pairs.end(), candidates.pairs.begin(),
                   [](GrainPair a, GrainPair b) { return a.a == b.a && a.b == b.b; }));
}

TEST_CASE("subdomains of a large bed hold all pairs and all grains") {
  for (SphereBed& bed : large_beds()) {
    const Candidates candidates = candidates_of(bed);
    Subdomains subdomains;
    divide(bed, candidates, serial_for, subdomains);
    REQUIRE(subdomains.count >= 3);
    CHECK(subdomains.count <= bed.subdomains);
    REQUIRE(subdomains.begin.size() == subdomains.count + 1);
    CHECK(subdomains.begin[0] == 0);
    CHECK(subdomains.begin[subdomains.count] == candidates.pairs.size());
    CHECK(sorted(subdomains.pairs) == sorted(candidates.pairs));
    REQUIRE(subdomains.first_grain.size() == subdomains.count + 1);
    std::vector<std::int32_t> grains = subdomains.grains;
    for (std::size_t subdomain = 0; subdomain < subdomains.count; ++subdomain) {
      for (std::size_t k = subdomains.first_grain[subdomain];
           k < subdomains.first_grain[subdomain + 1]; ++k) {
        REQUIRE(subdomains.subdomain_of(grains[k]) == subdomain);
      }
    }
    std::sort(grains.begin(), grains.end());
    for (std::size_t k = 0; k < grains.size(); ++k) {
      REQUIRE(grains[k] == static_cast<std::int32_t>(k));
    }
    CHECK(grains.size() == bed.grains());
  }
}

TEST_CASE("every second subdomain of a large bed shares no grain") {
  for (SphereBed& bed : large_beds()) {
    const Candidates candidates = candidates_of(bed);
    Subdomains subdomains;
    divide(bed, candidates, serial_for, subdomains);
    for (std::size_t parity = 0; parity < 2; ++parity) {
      std::vector<std::size_t> owner(bed.grains(), subdomains.count);
      for (std::size_t subdomain = parity; subdomain < subdomains.count; subdomain += 2) {
        for (std::size_t k = subdomains.begin[subdomain]; k < subdomains.begin[subdomain + 1];
             ++k) {
          for (const std::int32_t grain : {subdomains.pairs[k].a, subdomains.pairs[k].b}) {
            std::size_t& mine = owner[static_cast<std::size_t>(grain)];
            mine = mine == subdomains.count ? subdomain : mine;
            REQUIRE(mine == subdomain);
          }
        }
      }
    }
  }
}

TEST_CASE("subdomains of a flat bed lie along it, of a ring an even number") {
  for (const Boundary x : {Boundary::walls, Boundary::periodic}) {
    SphereBed bed = flat_bed(x);
    REQUIRE(bed.subdomain_axis == 0);
    const Candidates candidates = candidates_of(bed);
    Subdomains subdomains;
    divide(bed, candidates, serial_for, subdomains);
    CHECK(subdomains.is_ring == (x == Boundary::periodic));
    if (subdomains.is_ring) CHECK(subdomains.count % 2 == 0);
    std::vector<double> last(subdomains.count, 0.0);
    for (std::size_t i = 0; i < bed.grains(); ++i) {
      double& end = last[subdomains.subdomain_of(static_cast<std::int32_t>(i))];
      end = std::max(end, bed.position[i].x);
    }
    CHECK(std::is_sorted(last.begin(), last.end()));
  }
}

TEST_CASE("subdomains keep the order of their pairs, whoever sorts them") {
  SphereBed bed = tall_bed(30'000, Boundary::periodic);
  const Candidates candidates = candidates_of(bed);
  Subdomains plain;
  divide(bed, candidates, serial_for, plain);
  const auto subdomain = [&](GrainPair pair) { return plain.subdomain_of(pair); };
  std::vector<GrainPair> expected = candidates.pairs;
  std::stable_sort(expected.begin(), expected.end(),
                   [&](GrainPair p, GrainPair q) { return subdomain(p) < subdomain(q); });
  for (const ParallelFor& loop : {ParallelFor(serial_for), ParallelFor(testing::last_part_first),
                                  ParallelFor(testing::two_threads)}) {
    Subdomains subdomains;
    divide(bed, candidates, loop, subdomains);
    CHECK(std::equal(subdomains.pairs.begin(), subdomains.pairs.end(), expected.begin(),
                     expected.end(),
                     [](GrainPair p, GrainPair q) { return p.a == q.a && p.b == q.b; }));
    CHECK(subdomains.begin == plain.begin);
    CHECK(subdomains.grains == plain.grains);
  }
}

TEST_CASE("a large bed that is flat has no more subdomains than slabs") {
  testing::RandomScene scene;
  scene.box = {100, 100, Boundary::periodic, Boundary::periodic};
  scene.grains = 20'000;
  scene.height = 3.0;
  SphereBed bed = testing::random_bed(scene);
  const Candidates candidates = candidates_of(bed);
  Subdomains subdomains;
  divide(bed, candidates, serial_for, subdomains);
  CHECK(subdomains.count >= 1);
  CHECK(subdomains.count <= subdomains.slab_size.size());
}

/// Rows of a large bed, laid out by `loop` on top of rows that pushed.
SphereContacts<float> laid_out(const Candidates& candidates, const SphereBed& bed,
                               const ParallelFor& loop) {
  SphereContacts<float> contacts;
  lay_out(bed, candidates, contacts, loop);
  for (std::size_t k = 0; k < contacts.impulse.size(); ++k) {
    const bool is_void = bed.is_void(contacts.rows[k / block_width].a(k % block_width));
    contacts.impulse[k] = k % 3 == 0 && !is_void ? static_cast<float>(k % 101) : 0.0F;
  }
  lay_out(bed, candidates, contacts, loop);
  update_gaps(bed, {kernels(), loop}, 0.5, contacts);
  return contacts;
}

/// Grains that the rows of a part name, and entries of its subdomain that are none.
std::set<std::int32_t> named_by(const SphereContacts<float>& contacts, const RowPart& part) {
  std::set<std::int32_t> names;
  for (std::size_t k = part.first_range; k < part.first_range + part.ranges; ++k) {
    const BlockRange& range = contacts.shares.ranges[k];
    for (std::size_t block = range.first; block < range.first + range.blocks; ++block) {
      for (std::size_t lane = 0; lane < block_width; ++lane) {
        names.insert({contacts.rows[block].a(lane), contacts.rows[block].b(lane)});
      }
    }
  }
  return names;
}

std::vector<std::int32_t> grains_of(const RowShares& shares, const RowPart& part) {
  const auto first = shares.grains.begin() + static_cast<std::ptrdiff_t>(part.first_grain);
  return {first, first + static_cast<std::ptrdiff_t>(part.grains)};
}

TEST_CASE("parts of a phase name nothing twice, and cover all blocks once") {
  for (SphereBed& bed : large_beds()) {
    const Candidates candidates = candidates_of(bed);
    const SphereContacts<float> contacts = laid_out(candidates, bed, serial_for);
    REQUIRE(contacts.shares.phases() == 2);
    REQUIRE(contacts.shares.parts.size() >= 4);
    std::vector<int> covered(contacts.rows.size(), 0);
    for (const BlockRange& range : contacts.shares.ranges) {
      for (std::size_t k = range.first; k < range.first + range.blocks; ++k) ++covered[k];
    }
    CHECK(std::all_of(covered.begin(), covered.end(), [](int times) { return times == 1; }));
    for (std::size_t phase = 0; phase < 2; ++phase) {
      const PhaseParts parts = parts_of_phase(contacts.shares, phase);
      std::set<std::int32_t> taken;
      for (std::size_t k = parts.first; k < parts.last; ++k) {
        CHECK(contacts.shares.parts[k].phase == phase);
        for (const std::int32_t name : named_by(contacts, contacts.shares.parts[k])) {
          REQUIRE(taken.insert(name).second);
        }
      }
    }
  }
}

TEST_CASE("each phase names all grains once, and no other part of it pushes them") {
  for (SphereBed& bed : large_beds()) {
    const Candidates candidates = candidates_of(bed);
    const SphereContacts<float> contacts = laid_out(candidates, bed, serial_for);
    for (std::size_t phase = 0; phase < 2; ++phase) {
      const PhaseParts parts = parts_of_phase(contacts.shares, phase);
      std::vector<std::size_t> owner(bed.grains(), parts.last);
      for (std::size_t k = parts.first; k < parts.last; ++k) {
        for (const std::int32_t grain : grains_of(contacts.shares, contacts.shares.parts[k])) {
          REQUIRE(std::exchange(owner[static_cast<std::size_t>(grain)], k) == parts.last);
        }
      }
      CHECK(std::count(owner.begin(), owner.end(), parts.last) == 0);
      for (std::size_t k = parts.first; k < parts.last; ++k) {
        for (const std::int32_t name : named_by(contacts, contacts.shares.parts[k])) {
          if (name < bed.wall()) REQUIRE(owner[static_cast<std::size_t>(name)] == k);
        }
      }
    }
  }
}

TEST_CASE("a small bed is one part of all its blocks") {
  SphereBed bed = tall_bed(2000, Boundary::walls);
  const Candidates candidates = candidates_of(bed);
  const SphereContacts<float> contacts = laid_out(candidates, bed, serial_for);
  REQUIRE(contacts.shares.parts.size() == 1);
  CHECK(contacts.shares.phases() == 1);
  std::size_t next = 0;
  for (const BlockRange& range : contacts.shares.ranges) {
    CHECK(range.first == next);
    next += range.blocks;
  }
  CHECK(next == contacts.rows.size());
}

TEST_CASE("rows are the same in whatever order their parts are laid out") {
  SphereBed bed = tall_bed(30'000, Boundary::walls);
  const Candidates candidates = candidates_of(bed);
  const SphereContacts<float> plain = laid_out(candidates, bed, serial_for);
  for (const ParallelFor& loop :
       {ParallelFor(testing::last_part_first), ParallelFor(testing::two_threads)}) {
    const SphereContacts<float> other = laid_out(candidates, bed, loop);
    CHECK(other.impulse == plain.impulse);
    REQUIRE(other.rows.size() == plain.rows.size());
    for (std::size_t block = 0; block < plain.rows.size(); ++block) {
      const RowBlock<float>&a = plain.rows[block], &b = other.rows[block];
      REQUIRE(std::equal(a.gap, a.gap + block_width, b.gap));
      REQUIRE(std::equal(a.offset_a, a.offset_a + block_width, b.offset_a));
      REQUIRE(std::equal(a.offset_b, a.offset_b + block_width, b.offset_b));
    }
  }
}

TEST_CASE("candidates of a large bed are the same in whatever order their parts are searched") {
  SphereBed bed = tall_bed(40'000, Boundary::walls);
  const Candidates plain = candidates_of(bed);
  for (const ParallelFor& loop :
       {ParallelFor(testing::last_part_first), ParallelFor(testing::two_threads)}) {
    Candidates other;
    wrap(bed);
    find_candidates({bed, bed.position}, 0.1, {kernels(), loop}, other);
    REQUIRE(other.pairs.size() == plain.pairs.size());
    CHECK(std::equal(plain.pairs.begin(), plain.pairs.end(), other.pairs.begin(),
                     [](GrainPair a, GrainPair b) { return a.a == b.a && a.b == b.b; }));
  }
}

}  // namespace
}  // namespace grainsweep
