#include <algorithm>
#include <numeric>
#include <vector>

#include <catch2/catch.hpp>

#include "kernels/kernels.hpp"
#include "tests/kernels/row_grains.hpp"
#include "tests/support/bits.hpp"
#include "tests/support/draw.hpp"
#include "tests/support/instruction_sets.hpp"
#include "tests/support/row_twins.hpp"

namespace grainsweep {
namespace {

using testing::Draw;
using testing::same_bits;

template <class Real>
struct RowProblem {
  std::vector<RowBlock<Real>> rows;
  std::vector<Record<Real>> u, accumulated;
  std::vector<Real> p, y;
};

template <class Real>
void set_void(RowBlock<Real>& block, std::size_t lane) {
  block.set_grains(lane, void_a, void_b);
  block.normal_x[lane] = block.normal_y[lane] = 0;
  block.normal_z[lane] = -1;
  block.gap[lane] = 1;
  block.reduced_mass[lane] = static_cast<Real>(0.5);
}

template <class Real>
void set_row(RowBlock<Real>& block, std::size_t lane, std::int32_t a, std::int32_t b, Draw& draw) {
  const Draw::Direction n = draw.direction();
  block.set_grains(lane, a, b);
  block.normal_x[lane] = static_cast<Real>(n.x);
  block.normal_y[lane] = static_cast<Real>(n.y);
  block.normal_z[lane] = static_cast<Real>(n.z);
  block.gap[lane] = static_cast<Real>(draw.uniform(-0.1, 0.1));
  block.reduced_mass[lane] = static_cast<Real>(draw.uniform(0.01, 5.0));
}

/// A block of pairs or of contacts with the wall: no grain twice, the last lanes often void.
template <class Real>
RowBlock<Real> random_block(bool of_wall, Draw& draw) {
  std::vector<std::int32_t> names(row_grains);
  std::iota(names.begin(), names.end(), 0);
  draw.shuffle(names);
  const std::size_t used = draw.chance(0.5) ? block_width : draw.below(block_width + 1);
  RowBlock<Real> block;
  for (std::size_t lane = 0; lane < block_width; ++lane) {
    if (lane < used) {
      set_row(block, lane, names[2 * lane], of_wall ? wall : names[2 * lane + 1], draw);
    } else {
      set_void(block, lane);
    }
  }
  return block;
}

/// Grains at rest, with zeros of either sign among their motions, the wall and the void.
template <class Real>
std::vector<Record<Real>> random_motion(Draw& draw) {
  const auto component = [&] {
    return static_cast<Real>(draw.chance(0.1) ? (draw.chance(0.5) ? 0.0 : -0.0)
                                              : draw.uniform(-0.1, 0.1));
  };
  std::vector<Record<Real>> motion;
  for (std::int32_t i = 0; i < row_grains; ++i) {
    const Real x = component(), y = component(), z = component();
    motion.push_back({x, y, z, static_cast<Real>(draw.uniform(0.1, 125.0))});
  }
  motion.insert(motion.end(), {{0, 0, 0, 0}, {0, 0, 0, 1}, {0, 0, 0, 1}});
  return motion;
}

template <class Real>
RowProblem<Real> random_row_problem(std::size_t blocks, std::uint64_t seed) {
  Draw draw(seed);
  RowProblem<Real> problem{{}, random_motion<Real>(draw), random_motion<Real>(draw), {}, {}};
  for (Record<Real>& push : problem.accumulated) {  // sums that began at +0: never -0
    push = {push.x + Real(0), push.y + Real(0), push.z + Real(0), Real(0)};
  }
  for (std::size_t block = 0; block < blocks; ++block) {
    problem.rows.push_back(random_block<Real>(draw.chance(0.2), draw));
    for (std::size_t lane = 0; lane < block_width; ++lane) {
      const bool pushes = problem.rows.back().a(lane) != void_a && draw.chance(0.5);
      problem.p.push_back(static_cast<Real>(pushes ? draw.uniform(0.0, 0.05) : 0.0));
      problem.y.push_back(static_cast<Real>(pushes ? draw.uniform(-0.01, 0.05) : 0.0));
    }
  }
  return problem;
}

/// Calls compare(kernels of one instruction set, problem, copy of the problem) for problems of
/// many sizes, on every instruction set that can run here.
template <class Real, class Compare>
void on_random_row_problems(Compare compare) {
  for (const Isa isa : testing::testable_isas()) {
    for (const std::size_t blocks : {0U, 1U, 2U, 7U, 40U}) {
      for (std::uint64_t seed = 0; seed < 5; ++seed) {
        INFO(name_of(isa) << ", " << blocks << " blocks, seed " << seed);
        RowProblem<Real> problem = random_row_problem<Real>(blocks, 100 * blocks + seed);
        RowProblem<Real> twin = problem;
        compare(kernels_of<Real>(kernels_for(isa)).rows, problem, twin);
        REQUIRE(same_bits(problem.p, twin.p));
        REQUIRE(same_bits(problem.y, twin.y));
        REQUIRE(same_bits(problem.u, twin.u));
        REQUIRE(same_bits(problem.accumulated, twin.accumulated));
      }
    }
  }
}

TEMPLATE_TEST_CASE("a Gauss-Seidel sweep gives the bits of its plain-loop twin", "", float,
                   double) {
  const SweepRule<TestType> rule{TestType(0.9), TestType(0.7)};
  on_random_row_problems<TestType>([&](const auto& kernels, auto& problem, auto& twin) {
    const auto sums =
        kernels.gauss_seidel_sweep(problem.rows.data(), problem.rows.size(), nullptr,
                                   problem.u.data(), problem.p.data(), problem.y.data(), rule);
    const auto expected =
        testing::gauss_seidel_twin<TestType>(twin.rows.data(), twin.rows.size(), nullptr,
                                             twin.u.data(), twin.p.data(), twin.y.data(), rule);
    REQUIRE(same_bits(sums.missed, expected.missed));
    REQUIRE(same_bits(sums.restart_test, expected.restart_test));
  });
}

/// Impulses that those of a problem may be changes of: half of its rows push.
template <class Real>
std::vector<Real> impulses_before(const RowProblem<Real>& problem) {
  Draw draw(problem.p.size());
  std::vector<Real> before;
  for (std::size_t k = 0; k < problem.p.size(); ++k) {
    const bool is_void = problem.rows[k / block_width].a(k % block_width) == void_a;
    const bool pushes = !is_void && draw.chance(0.5);
    before.push_back(static_cast<Real>(pushes ? draw.uniform(0.0, 2.0) : 0.0));
  }
  return before;
}

TEMPLATE_TEST_CASE("a sweep of changes of impulses gives the bits of its plain-loop twin", "",
                   float, double) {
  const SweepRule<TestType> rule{TestType(0.9), TestType(0.7)};
  on_random_row_problems<TestType>([&](const auto& kernels, auto& problem, auto& twin) {
    const std::vector<TestType> from = impulses_before(problem);
    const auto sums =
        kernels.gauss_seidel_sweep(problem.rows.data(), problem.rows.size(), from.data(),
                                   problem.u.data(), problem.p.data(), problem.y.data(), rule);
    const auto expected =
        testing::gauss_seidel_twin(twin.rows.data(), twin.rows.size(), from.data(), twin.u.data(),
                                   twin.p.data(), twin.y.data(), rule);
    REQUIRE(same_bits(sums.missed, expected.missed));
    REQUIRE(same_bits(sums.restart_test, expected.restart_test));
    for (std::size_t k = 0; k < from.size(); ++k) REQUIRE(from[k] + problem.p[k] >= 0);
    REQUIRE(same_bits(kernels.residual(problem.rows.data(), problem.rows.size(), from.data(),
                                       problem.u.data(), problem.p.data()),
                      testing::residual_twin(twin.rows.data(), twin.rows.size(), from.data(),
                                             twin.u.data(), twin.p.data())));
  });
}

TEMPLATE_TEST_CASE("a Gauss-Seidel sweep without momentum needs one column of impulses", "", float,
                   double) {
  on_random_row_problems<TestType>([](const auto& kernels, auto& problem, auto& twin) {
    twin.y = twin.p;
    const auto sums = kernels.gauss_seidel_sweep(problem.rows.data(), problem.rows.size(), nullptr,
                                                 problem.u.data(), problem.p.data(),
                                                 problem.p.data(), SweepRule<TestType>{});
    const auto expected =
        kernels.gauss_seidel_sweep(twin.rows.data(), twin.rows.size(), nullptr, twin.u.data(),
                                   twin.p.data(), twin.y.data(), SweepRule<TestType>{});
    REQUIRE(same_bits(sums.missed, expected.missed));
    problem.y = problem.p;
  });
}

TEMPLATE_TEST_CASE("extrapolated motion has the bits of its plain-loop twin", "", float, double) {
  on_random_row_problems<TestType>([](const auto& kernels, auto& problem, auto& twin) {
    const auto momentum = TestType(0.7);
    kernels.extrapolate(momentum, problem.u.size(), problem.accumulated.data(), problem.u.data());
    testing::extrapolate_twin(momentum, twin.u.size(), twin.accumulated.data(), twin.u.data());
  });
}

TEMPLATE_TEST_CASE("grains extrapolated by their names move as all of them do", "", float, double) {
  const auto momentum = TestType(0.7);
  for (const std::size_t records : {1U, 2U}) {
    on_random_row_problems<TestType>([&](const auto& kernels, auto& problem, auto& twin) {
      const std::vector<std::int32_t> grains = {3, 0, row_grains / 2 - 1, 7};
      kernels.extrapolate_grains(momentum, grains.data(), grains.size(), records,
                                 problem.accumulated.data(), problem.u.data());
      for (const std::int32_t grain : grains) {
        const auto first = records * static_cast<std::size_t>(grain);
        testing::extrapolate_twin(momentum, records, twin.accumulated.data() + first,
                                  twin.u.data() + first);
      }
    });
  }
}

TEMPLATE_TEST_CASE("motion goes on by a share of its change, record by record", "", float, double) {
  using Records = std::vector<Record<TestType>>;
  constexpr std::size_t records = 12;  // more than any register holds
  for (const Isa isa : testing::testable_isas()) {
    for (std::size_t count = 0; count < records; ++count) {
      INFO(name_of(isa) << ", " << count << " of " << records);
      const auto taken = static_cast<std::ptrdiff_t>(count);
      Records before(records, {1, 1, 1, 4}), u(records, {3, 1, -1, 4}), last = before, next = u;
      std::fill(last.begin(), last.begin() + taken, Record<TestType>{3, 1, -1, 4});
      std::fill(next.begin(), next.begin() + taken, Record<TestType>{4, 1, -2, 4});
      kernels_of<TestType>(kernels_for(isa))
          .rows.extrapolate(TestType(0.5), count, before.data(), u.data());
      CHECK(same_bits(u, next));
      CHECK(same_bits(before, last));
    }
  }
}

TEMPLATE_TEST_CASE("accumulated impulses have the bits of their plain-loop twin", "", float,
                   double) {
  on_random_row_problems<TestType>([](const auto& kernels, auto& problem, auto& twin) {
    kernels.accumulate_impulses(problem.rows.data(), problem.rows.size(), problem.p.data(),
                                problem.accumulated.data());
    testing::accumulate_impulses_twin(twin.rows.data(), twin.rows.size(), twin.p.data(),
                                      twin.accumulated.data());
  });
}

TEMPLATE_TEST_CASE("accumulated impulses become motions with the bits of their plain-loop twin", "",
                   float, double) {
  on_random_row_problems<TestType>([](const auto& kernels, auto& problem, auto& twin) {
    const auto free = problem.u;
    kernels.apply_impulses(free.data(), free.size(), problem.accumulated.data(), problem.u.data());
    testing::apply_impulses_twin(free.data(), free.size(), twin.accumulated.data(), twin.u.data());
  });
}

TEMPLATE_TEST_CASE("accumulated impulses are divided by the masses and are gone then", "", float,
                   double) {
  using Records = std::vector<Record<TestType>>;
  constexpr std::size_t records = 12;  // more than any register holds
  const Records free(records, {1, 2, 3, 4}), before(records, {1, -1, 0.5, 0}),
      still(records, {7, 7, 7, 7});
  for (const Isa isa : testing::testable_isas()) {
    for (std::size_t count = 0; count < records; ++count) {
      INFO(name_of(isa) << ", " << count << " of " << records);
      const auto taken = static_cast<std::ptrdiff_t>(count);
      Records accumulated = before, u = still, accumulated_after = before, u_after = still;
      std::fill(accumulated_after.begin(), accumulated_after.begin() + taken,
                Record<TestType>{0, 0, 0, 0});
      std::fill(u_after.begin(), u_after.begin() + taken, Record<TestType>{5, -2, 5, 4});
      kernels_of<TestType>(kernels_for(isa))
          .rows.apply_impulses(free.data(), count, accumulated.data(), u.data());
      CHECK(same_bits(u, u_after));
      CHECK(same_bits(accumulated, accumulated_after));
    }
  }
}

TEMPLATE_TEST_CASE("the residual has the bits of its plain-loop twin", "", float, double) {
  on_random_row_problems<TestType>([](const auto& kernels, auto& problem, auto& twin) {
    const auto residual = kernels.residual(problem.rows.data(), problem.rows.size(), nullptr,
                                           problem.u.data(), problem.p.data());
    REQUIRE(same_bits(residual,
                      testing::residual_twin<TestType>(twin.rows.data(), twin.rows.size(), nullptr,
                                                       twin.u.data(), twin.p.data())));
  });
}

/// Positions in and slightly beyond a box of 7 x 5, some of them exactly half a period apart.
std::vector<Record<double>> random_positions(Draw& draw) {
  std::vector<Record<double>> positions;
  for (std::int32_t i = 0; i < row_grains; ++i) {
    const double x =
        draw.chance(0.3) ? 3.5 * static_cast<double>(draw.below(3)) : draw.uniform(-1.0, 8.0);
    const double y = draw.uniform(-1.0, 6.0), z = draw.uniform(0.0, 3.0);
    positions.push_back({x, y, z, draw.uniform(0.1, 0.5)});
  }
  positions.insert(positions.end(), {{0, 0, -1e9, 0}, {0, 0, -2e9, 0}, {0, 0, -3e9, 0}});
  return positions;
}

TEMPLATE_TEST_CASE("normals and gaps have the bits of their plain-loop twin", "", float, double) {
  Draw draw(5);
  const std::vector<Record<double>> positions = random_positions(draw);
  for (const double period_x : {0.0, 7.0}) {
    for (const double period_y : {0.0, 5.0}) {
      for (const double correction : {0.1, 1.0}) {
        on_random_row_problems<TestType>([&](const auto& kernels, auto& problem, auto& twin) {
          const double sunk = kernels.sphere_gaps(problem.rows.data(), problem.rows.size(),
                                                  positions.data(), period_x, period_y, correction);
          REQUIRE(sunk == testing::sphere_gaps_twin(twin.rows.data(), twin.rows.size(),
                                                    positions.data(), period_x, period_y,
                                                    correction));
          REQUIRE(same_bits(problem.rows, twin.rows));
        });
      }
    }
  }
}

/// One row between grains 0 and 1, everything else void.
template <class Real>
RowProblem<Real> one_row(Real gap, Real reduced_mass = Real(0.5)) {
  RowProblem<Real> problem{std::vector<RowBlock<Real>>(1),
                           std::vector<Record<Real>>(row_grains + 3, Record<Real>{0, 0, 0, 1}),
                           {},
                           std::vector<Real>(block_width, 0),
                           {}};
  for (std::size_t lane = 0; lane < block_width; ++lane) {
    set_void(problem.rows[0], lane);
  }
  problem.rows[0].set_grains(3, 0, 1);
  problem.rows[0].normal_x[3] = 1;
  problem.rows[0].normal_z[3] = 0;
  problem.rows[0].gap[3] = gap;
  problem.rows[0].reduced_mass[3] = reduced_mass;
  return problem;
}

TEMPLATE_TEST_CASE("one Gauss-Seidel sweep stops two grains where they meet", "", float, double) {
  for (const Isa isa : testing::testable_isas()) {
    INFO(name_of(isa));
    RowProblem<TestType> problem = one_row(TestType(0.25), TestType(0.25));
    problem.u[0] = {0.5, 0, 0, 1};   // mass 1
    problem.u[1] = {-0.5, 0, 0, 3};  // mass 1/3: they would overlap by .75
    const auto sums =
        kernels_of<TestType>(kernels_for(isa))
            .rows.gauss_seidel_sweep(problem.rows.data(), 1, nullptr, problem.u.data(),
                                     problem.p.data(), problem.p.data(), {});
    CHECK(problem.p[3] == TestType(0.75 / 4));
    CHECK(problem.u[0].x == TestType(0.5 - 0.75 / 4));
    CHECK(problem.u[1].x == TestType(-0.5 + 3 * 0.75 / 4));
    CHECK(sums.missed.largest == TestType(3 * 0.75 / 4));  // in masses of the lighter
  }
}

TEMPLATE_TEST_CASE("what a row misses counts in weights of its lighter grain", "", float, double) {
  for (const Isa isa : testing::testable_isas()) {
    INFO(name_of(isa));
    RowProblem<TestType> problem = one_row(TestType(-1), TestType(0.25));
    problem.u[0] = {0, 0, 0, 8};  // mass 1/8
    problem.u[1] = {0, 0, 0, TestType(0.5)};
    const auto missed =
        kernels_of<TestType>(kernels_for(isa))
            .rows.residual(problem.rows.data(), 1, nullptr, problem.u.data(), problem.p.data());
    CHECK(missed.largest == TestType(2));  // 0.25 of a mass of 1, 8 times as light
    CHECK(missed.squares == TestType(4));
    CHECK(missed.loaded == TestType(0));
    problem.p[3] = TestType(0.5);
    CHECK(kernels_of<TestType>(kernels_for(isa))
              .rows.residual(problem.rows.data(), 1, nullptr, problem.u.data(), problem.p.data())
              .loaded == TestType(1));
  }
}

TEMPLATE_TEST_CASE("a contact that opens loses its impulse", "", float, double) {
  for (const Isa isa : testing::testable_isas()) {
    INFO(name_of(isa));
    RowProblem<TestType> problem = one_row(TestType(1));
    problem.p[3] = TestType(0.125);
    kernels_of<TestType>(kernels_for(isa))
        .rows.gauss_seidel_sweep(problem.rows.data(), 1, nullptr, problem.u.data(),
                                 problem.p.data(), problem.p.data(), {});
    CHECK(problem.p[3] == 0);
    CHECK(problem.u[0].x == TestType(0.125));
    CHECK(problem.u[1].x == TestType(-0.125));
  }
}

TEMPLATE_TEST_CASE("an overlap is repaired by the share asked for, a gap is left as it is", "",
                   float, double) {
  std::vector<Record<double>> positions(row_grains + 3, Record<double>{0, 0, -1e9, 0});
  positions[void_b].z = -2e9;
  positions[0] = {6.75, 0, 0, 0.5};
  positions[1] = {0.5, 0, 0, 0.5};  // .75 apart across the border of a period of 7
  for (const Isa isa : testing::testable_isas()) {
    INFO(name_of(isa));
    RowProblem<TestType> problem = one_row(TestType(0));
    const auto& kernels = kernels_of<TestType>(kernels_for(isa)).rows;
    const double sunk = kernels.sphere_gaps(problem.rows.data(), 1, positions.data(), 7, 0, 0.5);
    CHECK(sunk == sunk_share - 0.75);  // .75 apart, and of radius .5
    CHECK(problem.rows[0].gap[3] == TestType(-0.125));
    CHECK(problem.rows[0].normal_x[3] == 1);
    CHECK(problem.rows[0].gap[0] == TestType(1e9));
    kernels.sphere_gaps(problem.rows.data(), 1, positions.data(), 0, 0, 0.5);
    CHECK(problem.rows[0].gap[3] == TestType(5.25));
    CHECK(problem.rows[0].normal_x[3] == -1);
  }
}

TEMPLATE_TEST_CASE("grains whose centres coincide are given a normal to part along", "", float,
                   double) {
  std::vector<Record<double>> positions(row_grains + 3, Record<double>{0, 0, -1e9, 0});
  positions[void_b].z = -2e9;
  positions[0] = positions[1] = {2, 3, 4, 0.5};
  for (const Isa isa : testing::testable_isas()) {
    INFO(name_of(isa));
    RowProblem<TestType> problem = one_row(TestType(0));
    const double sunk = kernels_of<TestType>(kernels_for(isa))
                            .rows.sphere_gaps(problem.rows.data(), 1, positions.data(), 0, 0, 1);
    CHECK(sunk == sunk_share);
    CHECK(problem.rows[0].gap[3] == -1);
    CHECK(problem.rows[0].normal_x[3] == 0);
    CHECK(problem.rows[0].normal_y[3] == 0);
    CHECK(problem.rows[0].normal_z[3] == 1);
  }
}

}  // namespace
}  // namespace grainsweep
