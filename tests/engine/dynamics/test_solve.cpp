#include <cmath>

#include <catch2/catch.hpp>

#include "engine/dynamics/solve.hpp"
#include "tests/support/about.hpp"
#include "tests/support/bits.hpp"
#include "tests/support/dense_solver.hpp"
#include "tests/support/draw.hpp"
#include "tests/support/instruction_sets.hpp"
#include "tests/support/named_contacts.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/solvers.hpp"
#include "tests/support/step_problems.hpp"

namespace grainsweep {
namespace {

using testing::all_solvers;
using testing::DenseProblem;
using testing::DenseSolution;
using testing::Draw;
using testing::kernels;
using testing::periodic;
using testing::random_problem;
using testing::StepProblem;
using testing::walls;

template <class Real>
DenseProblem dense(const StepProblem<Real>& problem) {
  return testing::dense_problem(problem.bed, problem.contacts, problem.motion.free);
}

/// The impulses that the solver left, as the oracle counts its rows.
template <class Real>
DenseSolution state_left(const StepProblem<Real>& problem) {
  std::vector<testing::Number> impulse;
  testing::visit_rows(problem.bed, problem.contacts,
                      [&](const RowBlock<Real>&, std::size_t, Real p) { impulse.push_back(p); });
  return testing::state_of(dense(problem), impulse);
}

template <class Real>
void expect_motion(const std::vector<Record<Real>>& u, const std::vector<testing::Number>& expected,
                   double margin) {
  for (std::size_t i = 0; i < u.size(); ++i) {
    REQUIRE(u[i].x == about(static_cast<double>(expected[3 * i]), margin));
    REQUIRE(u[i].y == about(static_cast<double>(expected[3 * i + 1]), margin));
    REQUIRE(u[i].z == about(static_cast<double>(expected[3 * i + 2]), margin));
  }
}

/// Solves problems of 1 to 16 grains and compares the motion, which is unique, with the oracle's.
template <class Real>
void expect_oracle_motion(Solver solver, double tolerance, double margin) {
  for (const std::int64_t grains : {1, 2, 5, 16}) {
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
      INFO("solver " << static_cast<int>(solver) << ", " << grains << " grains, seed " << seed);
      StepProblem<Real> problem = random_problem<Real>(grains, seed);
      const DenseSolution expected = testing::solve_dense(dense(problem));
      REQUIRE(expected.violation < 1e-15L);
      solve({solver, 5000, tolerance}, kernels(), problem.contacts, problem.motion);
      expect_motion(problem.motion.u, expected.u, margin);
    }
  }
}

TEST_CASE("every solver finds the motion of the reference solver in f64") {
  for (const Solver solver : all_solvers) {
    expect_oracle_motion<double>(solver, 1e-13, 1e-10);  // margin: tolerance times conditioning
  }
}

TEST_CASE("every solver finds the motion of the reference solver in f32") {
  for (const Solver solver : all_solvers) {
    expect_oracle_motion<float>(solver, 0.0, 2e-4);  // margin: where Gauss-Seidel stalls in f32
  }
}

TEST_CASE("contacts of the random problems do push") {
  StepProblem<double> problem = random_problem<double>(16, 3);
  solve({Solver::accelerated_gauss_seidel, 5000, 1e-12}, kernels(), problem.contacts,
        problem.motion);
  int pushing = 0;
  testing::visit_rows(
      problem.bed, problem.contacts,
      [&](const RowBlock<double>&, std::size_t, double p) { pushing += p > 1e-6 ? 1 : 0; });
  CHECK(pushing >= 16);
}

TEMPLATE_TEST_CASE("the residual reported is that of the impulses left behind", "", float, double) {
  const double rounding = std::is_same_v<TestType, float> ? 1e-6 : 1e-14;
  for (const Solver solver : all_solvers) {
    for (const int iterations : {2, 7, 30}) {
      INFO("solver " << static_cast<int>(solver) << ", " << iterations << " iterations");
      StepProblem<TestType> problem = random_problem<TestType>(16, 4);
      const SolveReport report =
          solve({solver, iterations, 0.0}, kernels(), problem.contacts, problem.motion);
      CHECK(report.iterations == iterations);
      const DenseSolution left = state_left(problem);
      CHECK(report.residual == about(static_cast<double>(left.violation), rounding));
      CHECK(report.rms <= report.residual);
      expect_motion(problem.motion.u, left.u, rounding);
    }
  }
}

TEMPLATE_TEST_CASE("impulses never pull", "", float, double) {
  for (const Solver solver : all_solvers) {
    for (const int iterations : {2, 4, 6, 8, 10, 12, 14, 16, 18, 20}) {
      StepProblem<TestType> problem = random_problem<TestType>(16, 5);
      solve({solver, iterations, 0.0}, kernels(), problem.contacts, problem.motion);
      testing::visit_rows(
          problem.bed, problem.contacts,
          [](const RowBlock<TestType>&, std::size_t, TestType p) { REQUIRE(p >= 0); });
    }
  }
}

/// Sum over the grains of m (u - free), and sum of the impulses that walls give to grains.
struct Balance {
  double change[3] = {0, 0, 0};
  double pushes[3] = {0, 0, 0};
};

Balance balance_of(const StepProblem<double>& problem) {
  Balance balance;
  for (std::size_t i = 0; i < problem.bed.grains(); ++i) {
    const Record<double>&u = problem.motion.u[i], &free = problem.motion.free[i];
    balance.change[0] += (u.x - free.x) / u.w;
    balance.change[1] += (u.y - free.y) / u.w;
    balance.change[2] += (u.z - free.z) / u.w;
  }
  testing::visit_rows(problem.bed, problem.contacts,
                      [&](const RowBlock<double>& r, std::size_t k, double p) {
                        const double push = r.b(k) == problem.bed.wall() ? p : 0.0;
                        balance.pushes[0] -= push * r.normal_x[k];
                        balance.pushes[1] -= push * r.normal_y[k];
                        balance.pushes[2] -= push * r.normal_z[k];
                      });
  return balance;
}

TEST_CASE("the grains' change of momentum is what the walls give, converged or not") {
  for (const Solver solver : all_solvers) {
    for (const int iterations : {2, 5, 500}) {
      for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        StepProblem<double> problem = random_problem<double>(16, seed);
        solve({solver, iterations, 0.0}, kernels(), problem.contacts, problem.motion);
        const Balance balance = balance_of(problem);
        for (int k = 0; k < 3; ++k) {
          CHECK(balance.change[k] == about(balance.pushes[k], 1e-13));
        }
        CHECK(balance.pushes[2] > 0.01);
      }
    }
  }
}

TEMPLATE_TEST_CASE("a solve that starts from its solution is done after one look at it", "", float,
                   double) {
  for (const Solver solver : all_solvers) {
    StepProblem<TestType> problem = random_problem<TestType>(16, 6);
    const double tolerance = 1e-5;
    const SolveReport first =
        solve({solver, 5000, tolerance}, kernels(), problem.contacts, problem.motion);
    REQUIRE(first.iterations > 1);
    REQUIRE(first.iterations < 5000);
    // A Gauss-Seidel sweep judges a row after those before it have moved: up to a few times worse.
    const double again_tolerance = 5 * first.residual;
    const SolveReport again =
        solve({solver, 5000, again_tolerance}, kernels(), problem.contacts, problem.motion);
    CHECK(again.iterations == 1);
    CHECK(again.residual <= again_tolerance);
  }
}

/// The same problem in other units of length and mass.
template <class Real>
StepProblem<Real> scaled(StepProblem<Real> problem, Real length) {
  for (RowBlock<Real>& block : problem.contacts.rows) {
    for (std::size_t lane = 0; lane < block_width; ++lane) {
      block.gap[lane] *= length;
    }
  }
  for (Record<Real>& free : problem.motion.free) {
    free = {free.x * length, free.y * length, free.z * length, free.w};
  }
  return problem;
}

// Lengths scale gaps and motions, hence also g dt^2, and impulses.
TEMPLATE_TEST_CASE("scaling lengths and gravity by powers of two changes no bit", "", float,
                   double) {
  for (const Solver solver : all_solvers) {
    for (const double length : {8.0, 0.0625}) {
      INFO("solver " << static_cast<int>(solver) << ", length " << length);
      StepProblem<TestType> plain = random_problem<TestType>(16, 7);
      StepProblem<TestType> other = scaled(plain, static_cast<TestType>(length));
      const double tolerance = 1e-4;
      const SolveReport a =
          solve({solver, 300, tolerance}, kernels(), plain.contacts, plain.motion);
      const SolveReport b =
          solve({solver, 300, tolerance * length}, kernels(), other.contacts, other.motion);
      CHECK(a.iterations == b.iterations);
      CHECK(a.residual * length == b.residual);
      for (TestType& p : plain.contacts.impulse) {
        p *= static_cast<TestType>(length);
      }
      CHECK(testing::same_bits(plain.contacts.impulse, other.contacts.impulse));
      for (Record<TestType>& u : plain.motion.u) {
        const auto by = static_cast<TestType>(length);
        u = {u.x * by, u.y * by, u.z * by, u.w};
      }
      CHECK(testing::same_bits(plain.motion.u, other.motion.u));
    }
  }
}

TEST_CASE("without contacts grains move freely") {
  for (const Solver solver : all_solvers) {
    StepProblem<double> problem = random_problem<double>(1, 1);
    problem.bed.position[0].z = 100;
    problem.bed.position[0].x = problem.bed.position[0].y = 1.3;
    problem.contacts = testing::contacts_of<double>(problem.bed, 0.01, kernels());
    const SolveReport report =
        solve({solver, 100, 0.0}, kernels(), problem.contacts, problem.motion);
    CHECK(report.residual == 0);
    CHECK(report.iterations == 1);
    CHECK(problem.motion.u[0].x == problem.motion.free[0].x);
    CHECK(problem.motion.u[0].z == problem.motion.free[0].z);
  }
}

/// Sweeps that a column of grains on the floor needs for its weight, to 1e-8 m g.
int sweeps_for_a_column(int grains, Solver solver) {
  SphereBed bed = testing::column_bed(grains, 0.0);
  SphereContacts<double> contacts = testing::contacts_of<double>(bed, 0.1, kernels());
  MotionColumns<double> motion;
  motion.free = bed.motion;
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    motion.free[i].z = -1.0;
  }
  return solve({solver, 100'000, 1e-8}, kernels(), contacts, motion).iterations;
}

// An error spreads over a column of n grains in n^2 plain sweeps, in n with momentum: 4 times as
// many for one twice as high, and 2 times. The bounds lie in the middle between them.
TEST_CASE(
    "a tall column takes as many sweeps as it has grains with momentum, their square without") {
  const int plain = sweeps_for_a_column(25, Solver::projected_gauss_seidel);
  const int plain_twice = sweeps_for_a_column(50, Solver::projected_gauss_seidel);
  const int fast = sweeps_for_a_column(50, Solver::accelerated_gauss_seidel);
  const int fast_twice = sweeps_for_a_column(100, Solver::accelerated_gauss_seidel);
  INFO(plain << " and " << plain_twice << ", " << fast << " and " << fast_twice << " sweeps");
  CHECK(plain_twice > 3 * plain);
  CHECK(fast_twice < 3 * fast);
  CHECK(fast < plain_twice / 16);
}

/// The rows of a large bed of random overlaps, whose grains fall onto each other.
StepProblem<double> large_problem() {
  testing::RandomScene scene;
  scene.box = {20, 10, periodic, walls};
  scene.grains = large_bed_grains<Sphere>;
  scene.height = static_cast<double>(scene.grains) / 250.0;
  scene.min_radius = 0.3;
  Draw draw(3);
  StepProblem<double> problem{testing::random_bed(scene), {}, {}};
  problem.contacts = testing::contacts_of<double>(problem.bed, 0.1, kernels());
  problem.motion.free = colliding_motion<double>(problem.bed, draw);
  return problem;
}

TEST_CASE("a large bed shared out in two phases moves as in one, after as many sweeps") {
  const SolveLimits limits{Solver::accelerated_gauss_seidel, 5000, 1e-8};
  StepProblem<double> shared = large_problem(), whole = shared;
  REQUIRE(shared.contacts.shares.phases() == 2);
  whole.contacts.shares.parts = {{0, 0, whole.contacts.shares.ranges.size(), 0, 0}};
  const SolveReport turned = solve(limits, kernels(), shared.contacts, shared.motion);
  const SolveReport plain = solve(limits, kernels(), whole.contacts, whole.motion);
  REQUIRE(turned.residual <= limits.tolerance);
  REQUIRE(plain.residual <= limits.tolerance);
  CHECK(turned.iterations < 1.3 * plain.iterations);
  double farthest = 0.0;
  for (std::size_t i = 0; i < shared.bed.grains(); ++i) {
    const Record<double>&a = shared.motion.u[i], &b = whole.motion.u[i];
    farthest = std::max(farthest, std::hypot(a.x - b.x, a.y - b.y, a.z - b.z));
  }
  // Residuals of 1e-8 of each row; chains of some hundred rows add them up.
  CHECK(farthest < 1e-5);
}

// What steps before left in the columns of motion must not get into that of grains asleep.
TEST_CASE("grains asleep at the bottom of a large bed stand still through all sweeps") {
  constexpr std::size_t asleep = 500;
  StepProblem<double> problem = large_problem();
  const SolveLimits limits{Solver::accelerated_gauss_seidel, 100, 0.0};
  solve(limits, kernels(), problem.contacts, problem.motion);
  problem.bed.asleep.assign(problem.bed.grains(), 0);
  std::fill_n(problem.bed.asleep.begin(), asleep, std::uint8_t{1});
  problem.contacts = testing::contacts_of<double>(problem.bed, 0.1, kernels());
  REQUIRE(problem.contacts.shares.phases() == 2);
  std::fill_n(problem.motion.free.begin(), asleep, Record<double>{});
  problem.motion.first_moving = asleep;
  const SolveReport report = solve(limits, kernels(), problem.contacts, problem.motion);
  CHECK(report.residual < 0.1);
  for (std::size_t i = 0; i < asleep; ++i) {
    const Record<double>& u = problem.motion.u[i];
    REQUIRE((u.x == 0.0 && u.y == 0.0 && u.z == 0.0 && u.w == 0.0));
  }
}

TEST_CASE("a solve continues beyond its iterations until the residual is below its cap") {
  for (const Solver solver : all_solvers) {
    INFO("solver " << static_cast<int>(solver));
    SolveLimits limits{solver, 2, 0.0};
    StepProblem<double> problem = random_problem<double>(16, 4);
    const SolveReport crude = solve(limits, kernels(), problem.contacts, problem.motion);
    CHECK(crude.iterations == 2);
    limits.residual_cap = crude.residual / 100.0;
    for (const int iteration_cap : {2, 16, 10'000}) {
      limits.iteration_cap = iteration_cap;
      problem = random_problem<double>(16, 4);
      const SolveReport patient = solve(limits, kernels(), problem.contacts, problem.motion);
      CHECK(patient.iterations <= iteration_cap);
      CHECK((patient.residual <= limits.residual_cap || 2 * patient.iterations > iteration_cap));
    }
    CHECK(solve(limits, kernels(), problem.contacts, problem.motion).residual <=
          limits.residual_cap);
  }
}

TEST_CASE("a solve that rounding stops does not go on for a residual that it cannot reach") {
  for (const Solver solver : all_solvers) {
    INFO("solver " << static_cast<int>(solver));
    SolveLimits limits{solver, 16, 0.0};
    limits.residual_cap = 1e-12;  // far below the rounding of f32
    limits.iteration_cap = 100'000'000;
    StepProblem<float> problem = random_problem<float>(16, 4);
    const SolveReport report = solve(limits, kernels(), problem.contacts, problem.motion);
    CHECK(report.residual > limits.residual_cap);
    CHECK(report.residual < 1e-4);         // it has got as far as f32 goes
    CHECK(report.iterations < 1'000'000);  // 16 times a power of two; seconds here if it went on
  }
}

/// A random problem whose rows take so many times their own correction.
template <class Real>
StepProblem<Real> overcorrecting_problem(Real times, std::uint64_t seed) {
  StepProblem<Real> problem = random_problem<Real>(16, seed);
  for (RowBlock<Real>& block : problem.contacts.rows) {
    for (Real& mass : block.reduced_mass) mass *= times;
  }
  return problem;
}

// Relaxed by 0.9 rows take 1.8 times their correction, and plain sweeps converge up to twice.
TEST_CASE("momentum is given up where it makes sweeps diverge") {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    INFO("seed " << seed);
    StepProblem<double> problem = overcorrecting_problem(2.0, seed);
    const SolveReport report = solve({Solver::accelerated_gauss_seidel, 20'000, 1e-10}, kernels(),
                                     problem.contacts, problem.motion);
    CHECK(report.residual <= 1e-10);
    CHECK(report.iterations < 200);  // without momentum 117 to 130
  }
}

// What has become NaN is no maximum: it must not pass for a residual of 0.
TEMPLATE_TEST_CASE("a solve that diverges without momentum, too, has a large residual", "", float,
                   double) {
  for (const Solver solver : all_solvers) {
    INFO("solver " << static_cast<int>(solver));
    for (const int iterations : {1000, 20'000}) {
      StepProblem<TestType> problem = overcorrecting_problem<TestType>(TestType(5), 1);
      const SolveReport report =
          solve({solver, iterations, 1e-3}, kernels(), problem.contacts, problem.motion);
      CHECK(report.residual > 1);
      CHECK(report.iterations == iterations);
    }
  }
}

TEST_CASE("a more accurate solve takes more iterations and leaves a smaller residual") {
  for (const Solver solver : all_solvers) {
    double last_residual = 1;
    int last_iterations = 0;
    for (const double tolerance : {1e-3, 1e-6, 1e-9}) {
      StepProblem<double> problem = random_problem<double>(16, 8);
      const SolveReport report =
          solve({solver, 20'000, tolerance}, kernels(), problem.contacts, problem.motion);
      CHECK(report.residual < last_residual);
      CHECK(report.iterations > last_iterations);
      CHECK(report.residual <= tolerance);
      last_residual = report.residual;
      last_iterations = report.iterations;
    }
  }
}

}  // namespace
}  // namespace grainsweep
