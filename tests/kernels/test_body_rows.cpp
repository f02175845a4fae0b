#include <numeric>
#include <vector>

#include <catch2/catch.hpp>

#include "kernels/kernels.hpp"
#include "tests/kernels/row_grains.hpp"
#include "tests/support/bits.hpp"
#include "tests/support/body_twins.hpp"
#include "tests/support/draw.hpp"
#include "tests/support/instruction_sets.hpp"

namespace grainsweep {
namespace {

using testing::Draw;
using testing::same_bits;

template <class Real>
struct BodyProblem {
  std::vector<BodyBlock<Real>> blocks;
  std::vector<BodyPoints<Real>> points;
  std::vector<Record<Real>> u, accumulated;
  std::vector<Real> p, y;

  BodyRows<Real> rows() const { return {blocks.data(), points.data()}; }
};

template <class Real>
void set_point(BodyPoints<Real>& points, std::size_t lane, bool of_wall, Draw& draw) {
  for (std::size_t k = 0; k < 3; ++k) {
    points.lever_a[k][lane] = static_cast<Real>(draw.uniform(-3, 3));
    points.lever_b[k][lane] = of_wall ? Real(0) : static_cast<Real>(draw.uniform(-3, 3));
  }
  points.gap[lane] = static_cast<Real>(draw.uniform(-0.1, 0.1));
  points.reduced_mass[lane] = static_cast<Real>(draw.uniform(0.05, 1));
}

template <class Real>
void set_void_point(BodyPoints<Real>& points, std::size_t lane) {
  for (std::size_t k = 0; k < 3; ++k) points.lever_a[k][lane] = points.lever_b[k][lane] = 0;
  points.gap[lane] = points.reduced_mass[lane] = 1;
}

/// Appends the points of a lane that has fewer than its block at times.
template <class Real>
void set_lane(BodyProblem<Real>& problem, std::size_t lane, bool used, bool of_wall, Draw& draw) {
  const BodyBlock<Real>& block = problem.blocks.back();
  const std::size_t own = used ? 1 + draw.below(block.points) : 0;
  for (std::size_t i = 0; i < block.points; ++i) {
    BodyPoints<Real>& points = problem.points[block.first + i];
    i < own ? set_point(points, lane, of_wall, draw) : set_void_point(points, lane);
    const bool pushes = i < own && draw.chance(0.5);
    const std::size_t at = (block.first + i) * block_width + lane;
    problem.p[at] = static_cast<Real>(pushes ? draw.uniform(0, 0.05) : 0);
    problem.y[at] = static_cast<Real>(pushes ? draw.uniform(-0.01, 0.05) : 0);
  }
}

/// A block of pairs or of contacts with the wall: no grain twice, the last lanes often void.
template <class Real>
void add_block(BodyProblem<Real>& problem, bool of_wall, Draw& draw) {
  std::vector<std::int32_t> names(row_grains);
  std::iota(names.begin(), names.end(), 0);
  draw.shuffle(names);
  problem.blocks.emplace_back();
  BodyBlock<Real>& block = problem.blocks.back();
  block.first = static_cast<std::uint32_t>(problem.points.size());
  block.points = static_cast<std::uint32_t>(1 + draw.below(12));
  problem.points.resize(block.first + block.points);
  problem.p.resize(problem.points.size() * block_width);
  problem.y.resize(problem.p.size());
  const std::size_t used = draw.chance(0.5) ? block_width : draw.below(block_width + 1);
  for (std::size_t lane = 0; lane < block_width; ++lane) {
    const bool is_used = lane < used;
    const Draw::Direction n = is_used ? draw.direction() : Draw::Direction{0, 0, -1};
    block.set_grains(lane, is_used ? names[2 * lane] : void_a,
                     is_used ? (of_wall ? wall : names[2 * lane + 1]) : void_b);
    block.normal_x[lane] = static_cast<Real>(n.x);
    block.normal_y[lane] = static_cast<Real>(n.y);
    block.normal_z[lane] = static_cast<Real>(n.z);
    set_lane(problem, lane, is_used, of_wall, draw);
  }
}

template <class Real>
std::vector<Record<Real>> random_records(bool with_masses, Draw& draw) {
  const auto component = [&] {
    return draw.chance(0.1) ? Real(0) : static_cast<Real>(draw.uniform(-0.1, 0.1));
  };
  std::vector<Record<Real>> records;
  for (std::int32_t i = 0; i < 2 * row_grains; ++i) {
    const Real x = component(), y = component(), z = component();
    const double mass = i % 2 == 0 ? draw.uniform(0.5, 2) : 1;
    records.push_back({x, y, z, with_masses ? static_cast<Real>(mass) : Real(0)});
  }
  const Real any = with_masses ? Real(1) : Real(0);
  records.insert(
      records.end(),
      {{0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, any}, {0, 0, 0, any}, {0, 0, 0, any}, {0, 0, 0, any}});
  return records;
}

template <class Real>
BodyProblem<Real> random_body_problem(std::size_t blocks, std::uint64_t seed) {
  Draw draw(seed);
  BodyProblem<Real> problem;
  problem.u = random_records<Real>(true, draw);
  problem.accumulated = random_records<Real>(false, draw);
  for (std::size_t block = 0; block < blocks; ++block) add_block(problem, draw.chance(0.2), draw);
  return problem;
}

/// Calls compare(kernels of one instruction set, problem, copy of the problem) for problems of
/// many sizes, on every instruction set that can run here.
template <class Real, class Compare>
void on_random_body_problems(Compare compare) {
  for (const Isa isa : testing::testable_isas()) {
    for (const std::size_t blocks : {0U, 1U, 2U, 7U, 30U}) {
      for (std::uint64_t seed = 0; seed < 5; ++seed) {
        INFO(name_of(isa) << ", " << blocks << " blocks, seed " << seed);
        BodyProblem<Real> problem = random_body_problem<Real>(blocks, 100 * blocks + seed);
        BodyProblem<Real> twin = problem;
        compare(kernels_of<Real>(kernels_for(isa)).bodies, problem, twin);
        REQUIRE(same_bits(problem.p, twin.p));
        REQUIRE(same_bits(problem.y, twin.y));
        REQUIRE(same_bits(problem.u, twin.u));
        REQUIRE(same_bits(problem.accumulated, twin.accumulated));
      }
    }
  }
}

TEMPLATE_TEST_CASE("a Gauss-Seidel sweep over body rows gives the bits of its plain-loop twin", "",
                   float, double) {
  const SweepRule<TestType> rule{TestType(0.9), TestType(0.7)};
  on_random_body_problems<TestType>([&](const auto& kernels, auto& problem, auto& twin) {
    const auto sums =
        kernels.gauss_seidel_sweep(problem.rows(), problem.blocks.size(), problem.u.data(),
                                   problem.p.data(), problem.y.data(), rule);
    const auto expected = testing::body_gauss_seidel_twin(
        twin.rows(), twin.blocks.size(), twin.u.data(), twin.p.data(), twin.y.data(), rule);
    REQUIRE(same_bits(sums.missed, expected.missed));
    REQUIRE(same_bits(sums.restart_test, expected.restart_test));
  });
}

TEMPLATE_TEST_CASE("accumulated impulses of body rows have the bits of their plain-loop twin", "",
                   float, double) {
  on_random_body_problems<TestType>([](const auto& kernels, auto& problem, auto& twin) {
    kernels.accumulate_impulses(problem.rows(), problem.blocks.size(), problem.p.data(),
                                problem.accumulated.data());
    testing::body_accumulate_impulses_twin(twin.rows(), twin.blocks.size(), twin.p.data(),
                                           twin.accumulated.data());
  });
}

TEMPLATE_TEST_CASE("the residual over body rows has the bits of its plain-loop twin", "", float,
                   double) {
  on_random_body_problems<TestType>([](const auto& kernels, auto& problem, auto& twin) {
    const auto residual =
        kernels.residual(problem.rows(), problem.blocks.size(), problem.u.data(), problem.p.data());
    REQUIRE(same_bits(residual, testing::body_residual_twin(twin.rows(), twin.blocks.size(),
                                                            twin.u.data(), twin.p.data())));
  });
}

TEMPLATE_TEST_CASE("the gaps of body rows after a motion have the bits of their plain-loop twin",
                   "", float, double) {
  on_random_body_problems<TestType>([](const auto& kernels, auto& problem, auto& twin) {
    const TestType correction = TestType(0.1);
    for (auto* one : {&problem, &twin}) {
      for (auto& points : one->points) {
        for (std::size_t lane = 0; lane < block_width; lane += 3) points.gap[lane] *= -1;
      }
    }
    kernels.move_gaps(problem.rows(), problem.blocks.size(), problem.u.data(), correction,
                      problem.points.data());
    testing::body_move_gaps_twin(twin.rows(), twin.blocks.size(), twin.u.data(), correction,
                                 twin.points.data());
    for (std::size_t i = 0; i < problem.points.size(); ++i) {
      for (std::size_t lane = 0; lane < block_width; ++lane) {
        REQUIRE(same_bits(problem.points[i].gap[lane], twin.points[i].gap[lane]));
      }
    }
  });
}

/// Two grains of mass 1 and a point of contact between them, in lane 5.
template <class Real>
BodyProblem<Real> one_contact(Real lever_a, Real lever_b) {
  Draw draw(1);
  BodyProblem<Real> problem;
  problem.u = random_records<Real>(true, draw);
  for (Record<Real>& record : problem.u) record = {0, 0, 0, Real(1)};
  problem.accumulated.assign(problem.u.size(), {0, 0, 0, 0});
  problem.blocks.resize(1);
  problem.points.resize(1);
  problem.blocks[0].points = 1;
  problem.p.assign(block_width, 0);
  for (std::size_t lane = 0; lane < block_width; ++lane) {
    problem.blocks[0].set_grains(lane, lane == 5 ? 0 : void_a, lane == 5 ? 1 : void_b);
    problem.blocks[0].normal_x[lane] = 1;
    problem.blocks[0].normal_y[lane] = problem.blocks[0].normal_z[lane] = 0;
    set_void_point(problem.points[0], lane);
  }
  problem.points[0].lever_a[2][5] = lever_a;
  problem.points[0].lever_b[1][5] = lever_b;
  problem.points[0].gap[5] = 0;
  problem.points[0].reduced_mass[5] = 1 / (2 + lever_a * lever_a + lever_b * lever_b);
  return problem;
}

TEMPLATE_TEST_CASE("one impulse stops the approach of two grains at their point of contact", "",
                   float, double) {
  for (const Isa isa : testing::testable_isas()) {
    INFO(name_of(isa));
    BodyProblem<TestType> problem = one_contact(TestType(1), TestType(-1));
    problem.u[0].x = 1;  // a runs into b: the approach is 1, A is 4, so the impulse is 1/4
    const auto sums = kernels_of<TestType>(kernels_for(isa))
                          .bodies.gauss_seidel_sweep(problem.rows(), 1, problem.u.data(),
                                                     problem.p.data(), problem.p.data(), {});
    CHECK(sums.missed.largest == TestType(0.25));
    CHECK(problem.p[5] == TestType(0.25));
    CHECK(problem.u[0].x == TestType(0.75));
    CHECK(problem.u[1].z == TestType(-0.25));  // the turns that the levers of a and b give
    CHECK(problem.u[2].x == TestType(0.25));
    CHECK(problem.u[3].y == TestType(-0.25));
    CHECK(testing::point_twin(problem.rows(), 0, 5, 0).gap_after(problem.u.data()) == 0);
  }
}

}  // namespace
}  // namespace grainsweep
