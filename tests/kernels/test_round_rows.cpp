#include <cmath>
#include <limits>
#include <vector>

#include <catch2/catch.hpp>

#include "kernels/kernels.hpp"
#include "tests/support/about.hpp"
#include "tests/support/bits.hpp"
#include "tests/support/draw.hpp"
#include "tests/support/instruction_sets.hpp"

namespace grainsweep {
namespace {

using testing::Draw;
using testing::same_bits;

/// Contacts of as many grains with one round wall, in pairs of blocks; the last lanes are void.
template <class Real>
struct RoundProblem {
  std::vector<RowBlock<Real>> rows;
  std::vector<Record<Real>> u;
  std::vector<Real> p, y;
  std::size_t grains = 0;

  std::size_t at(std::size_t grain) const {
    return grain / block_width * 2 * block_width + grain % block_width;
  }
};

/// Sets the contact of a grain whose centre is (x, y) from the axis, with a gap from the wall.
template <class Real>
void set_contact(std::size_t grain, double x, double y, double gap, double mass,
                 RoundProblem<Real>& problem) {
  const std::size_t lane = grain % block_width;
  RowBlock<Real>* const pair = problem.rows.data() + grain / block_width * 2;
  for (int k : {0, 1}) pair[k].set_grains(lane, static_cast<std::int32_t>(grain), 0);
  pair[0].gap[lane] = static_cast<Real>(x);
  pair[1].gap[lane] = static_cast<Real>(y);
  pair[0].reduced_mass[lane] = static_cast<Real>(mass);
  pair[1].reduced_mass[lane] = static_cast<Real>(-gap * (2 * std::hypot(x, y) + gap));
  problem.u[grain].w = static_cast<Real>(1 / mass);
}

template <class Real>
RoundProblem<Real> round_problem(std::size_t grains) {
  RoundProblem<Real> problem;
  problem.grains = grains;
  problem.rows.resize(2 * ((grains + block_width - 1) / block_width));
  problem.u.assign(grains + 1, {0, 0, 0, 1});  // the last one is void
  for (std::size_t b = 0; b < problem.rows.size(); ++b) {
    for (std::size_t lane = 0; lane < block_width; ++lane) {
      problem.rows[b].set_grains(lane, static_cast<std::int32_t>(grains), 0);
      (b % 2 == 0 ? problem.rows[b].normal_x : problem.rows[b].normal_y)[lane] = -1;
      problem.rows[b].reduced_mass[lane] = b % 2 == 0 ? 1 : -1;
    }
  }
  problem.p.assign(problem.rows.size() * block_width, 0);
  problem.y = problem.p;
  return problem;
}

template <class Real>
RoundProblem<Real> random_round_problem(std::size_t grains, Draw& draw) {
  RoundProblem<Real> problem = round_problem<Real>(grains);
  for (std::size_t i = 0; i < grains; ++i) {
    const double angle = draw.uniform(0, 7), from_axis = draw.uniform(0, 3);
    problem.u[i] = {static_cast<Real>(draw.uniform(-0.1, 0.1)),
                    static_cast<Real>(draw.uniform(-0.1, 0.1)),
                    static_cast<Real>(draw.uniform(-0.1, 0.1)), 1};
    set_contact(i, from_axis * std::cos(angle), from_axis * std::sin(angle),
                draw.uniform(-0.03, 0.1), draw.uniform(0.1, 3), problem);
    if (draw.chance(0.3)) continue;
    for (const std::size_t at : {problem.at(i), problem.at(i) + block_width}) {
      problem.p[at] = static_cast<Real>(draw.uniform(-0.05, 0.05));
      problem.y[at] = static_cast<Real>(draw.uniform(-0.05, 0.05));
    }
  }
  return problem;
}

TEMPLATE_TEST_CASE("sweeps over round walls have the same bits on every instruction set", "", float,
                   double) {
  Draw draw(21);
  const SweepRule<TestType> rule{TestType(0.9), TestType(0.6)};
  for (const std::size_t grains : {1U, 15U, 16U, 33U, 100U}) {
    const RoundProblem<TestType> problem = random_round_problem<TestType>(grains, draw);
    RoundProblem<TestType> expected = problem;
    const auto& reference = kernels_of<TestType>(kernels_for(Isa::sse2)).rows;
    const auto sums =
        reference.round_sweep(expected.rows.data(), expected.rows.size(), nullptr,
                              expected.u.data(), expected.p.data(), expected.y.data(), rule);
    const auto left = reference.round_residual(expected.rows.data(), expected.rows.size(), nullptr,
                                               expected.u.data(), expected.p.data());
    for (const Isa isa : testing::testable_isas()) {
      INFO(name_of(isa) << ", " << grains << " grains");
      const auto& kernels = kernels_of<TestType>(kernels_for(isa)).rows;
      RoundProblem<TestType> twin = problem;
      const auto other = kernels.round_sweep(twin.rows.data(), twin.rows.size(), nullptr,
                                             twin.u.data(), twin.p.data(), twin.y.data(), rule);
      CHECK(same_bits(other.missed, sums.missed));
      CHECK(same_bits(other.restart_test, sums.restart_test));
      CHECK(same_bits(twin.p, expected.p));
      CHECK(same_bits(twin.y, expected.y));
      CHECK(same_bits(twin.u, expected.u));
      CHECK(same_bits(kernels.round_residual(twin.rows.data(), twin.rows.size(), nullptr,
                                             twin.u.data(), twin.p.data()),
                      left));
    }
  }
}

// Impulses of the problem are half changes and half what they are changes of.
TEMPLATE_TEST_CASE("sweeps over changes at round walls do what sweeps over the impulses do", "",
                   float, double) {
  // What rounding adds to places of up to 3 d, of grains as light as 0.1.
  constexpr double rounding = 64 * std::numeric_limits<TestType>::epsilon();
  Draw draw(23);
  const SweepRule<TestType> rule{TestType(0.9), TestType(0.6)};
  RoundProblem<TestType> whole = random_round_problem<TestType>(80, draw), changes = whole;
  for (TestType& p : changes.p) p /= 2;
  const std::vector<TestType> from = changes.p;
  for (std::size_t k = 0; k < from.size(); ++k) changes.y[k] = whole.y[k] - from[k];
  const auto& reference = kernels_of<TestType>(testing::kernels()).rows;
  const auto sums = reference.round_sweep(whole.rows.data(), whole.rows.size(), nullptr,
                                          whole.u.data(), whole.p.data(), whole.y.data(), rule);
  const auto left = reference.round_residual(whole.rows.data(), whole.rows.size(), nullptr,
                                             whole.u.data(), whole.p.data());
  std::vector<RoundProblem<TestType>> swept;
  for (const Isa isa : testing::testable_isas()) {
    INFO(name_of(isa));
    const auto& kernels = kernels_of<TestType>(kernels_for(isa)).rows;
    RoundProblem<TestType>& p = swept.emplace_back(changes);
    const auto other = kernels.round_sweep(p.rows.data(), p.rows.size(), from.data(), p.u.data(),
                                           p.p.data(), p.y.data(), rule);
    CHECK(other.missed.largest == about(sums.missed.largest, rounding));
    CHECK(other.missed.loaded == sums.missed.loaded);
    CHECK(other.restart_test == about(sums.restart_test, rounding));
    CHECK(kernels.round_residual(p.rows.data(), p.rows.size(), from.data(), p.u.data(), p.p.data())
              .largest == about(left.largest, rounding));
    for (std::size_t k = 0; k < from.size(); ++k) {
      CHECK(from[k] + p.p[k] == about(whole.p[k], rounding));
      CHECK(from[k] + p.y[k] == about(whole.y[k], rounding));
    }
    CHECK(same_bits(p.p, swept.front().p));
    CHECK(same_bits(p.y, swept.front().y));
    CHECK(same_bits(p.u, swept.front().u));
  }
}

// One sweep without relaxation or momentum solves a grain that touches nothing else: what moves it
// is the way back to the nearest point of the circle.
TEMPLATE_TEST_CASE("a grain that leaves a round wall's circle is put back on its nearest point", "",
                   float, double) {
  // What rounding adds to places of up to 3 d.
  constexpr double rounding = 16 * std::numeric_limits<TestType>::epsilon();
  Draw draw(22);
  RoundProblem<TestType> problem = random_round_problem<TestType>(80, draw);
  RoundProblem<TestType> start = problem;
  start.y = start.p = problem.y = problem.p;
  const auto& kernels = kernels_of<TestType>(testing::kernels()).rows;
  kernels.round_sweep(problem.rows.data(), problem.rows.size(), nullptr, problem.u.data(),
                      problem.p.data(), problem.y.data(), SweepRule<TestType>{});
  int outside = 0;
  for (std::size_t i = 0; i < problem.grains; ++i) {
    INFO("grain " << i);
    const std::size_t at = problem.at(i), lane = i % block_width;
    const RowBlock<TestType>* const pair = problem.rows.data() + i / block_width * 2;
    const double cx = pair[0].gap[lane], cy = pair[1].gap[lane], w = problem.u[i].w;
    const double radius = std::sqrt(cx * cx + cy * cy - pair[1].reduced_mass[lane]);
    // Where it would be without the wall, and the nearest point of the disc.
    const double x = cx + start.u[i].x - w * start.p[at];
    const double y = cy + start.u[i].y - w * start.p[at + block_width];
    const double far = std::hypot(x, y), keep = far > radius ? radius / far : 1.0;
    outside += far > radius ? 1 : 0;
    CHECK(cx + problem.u[i].x == about(keep * x, rounding));
    CHECK(cy + problem.u[i].y == about(keep * y, rounding));
    CHECK(problem.u[i].z == start.u[i].z);
    CHECK(w * problem.p[at] == about((keep - 1) * x, rounding));
    CHECK(w * problem.p[at + block_width] == about((keep - 1) * y, rounding));
  }
  CHECK((outside > 20 && outside < 70));
  const auto left = kernels.round_residual(problem.rows.data(), problem.rows.size(), nullptr,
                                           problem.u.data(), problem.p.data());
  CHECK(left.largest < 10 * rounding);  // of grains as light as 0.1, in masses of theirs
  CHECK(left.loaded == static_cast<TestType>(outside));
}

TEMPLATE_TEST_CASE("a grain that fills its tube is held on the axis, and one far inside is free",
                   "", float, double) {
  RoundProblem<TestType> problem = round_problem<TestType>(2);
  set_contact(0, 0, 0, 0, 2, problem);
  set_contact(1, 0.5, 0, 4, 2, problem);
  problem.u[0].x = problem.u[1].x = TestType(0.125);
  const auto& kernels = kernels_of<TestType>(testing::kernels()).rows;
  kernels.round_sweep(problem.rows.data(), problem.rows.size(), nullptr, problem.u.data(),
                      problem.p.data(), problem.y.data(), SweepRule<TestType>{});
  CHECK(problem.u[0].x == 0);
  CHECK(problem.p[0] == TestType(-0.25));
  CHECK(problem.u[1].x == TestType(0.125));
  CHECK(problem.p[1] == 0);
}

// Far from the axis a gap is a small difference of large numbers: f32 has 3e-5 d left at 500 d.
TEST_CASE("the gap of a wide tube keeps its digits in f32") {
  RoundProblem<float> problem = round_problem<float>(1);
  set_contact(0, 499.5, 0, 1e-5, 1, problem);
  problem.u[0].x = 3e-5F;
  const auto& kernels = kernels_of<float>(testing::kernels()).rows;
  kernels.round_sweep(problem.rows.data(), problem.rows.size(), nullptr, problem.u.data(),
                      problem.p.data(), problem.y.data(), SweepRule<float>{});
  CHECK(static_cast<double>(problem.u[0].x) == Approx(1e-5).epsilon(1e-5));
}

}  // namespace
}  // namespace grainsweep
