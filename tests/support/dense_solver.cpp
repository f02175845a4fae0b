#include "tests/support/dense_solver.hpp"

#include <algorithm>
#include <cmath>

namespace grainsweep::testing {

namespace {

Number diagonal(const DenseProblem& problem, const DenseRow& row) {
  return problem.inverse_mass[row.a] + problem.inverse_mass[row.b];
}

Number gap_after(const DenseRow& row, const std::vector<Number>& u) {
  Number gap = row.gap;
  for (std::size_t k = 0; k < 3; ++k) {
    gap += row.normal[k] * (u[3 * row.b + k] - u[3 * row.a + k]);
  }
  return gap;
}

void push(const DenseProblem& problem, const DenseRow& row, Number impulse,
          std::vector<Number>& u) {
  for (std::size_t k = 0; k < 3; ++k) {
    u[3 * row.a + k] -= impulse * problem.inverse_mass[row.a] * row.normal[k];
    u[3 * row.b + k] += impulse * problem.inverse_mass[row.b] * row.normal[k];
  }
}

void sweep(const DenseProblem& problem, DenseSolution& state) {
  for (std::size_t c = 0; c < problem.rows.size(); ++c) {
    const DenseRow& row = problem.rows[c];
    const Number step = gap_after(row, state.u) / diagonal(problem, row);
    const Number impulse = std::max(Number(0), state.impulse[c] - step);
    push(problem, row, impulse - state.impulse[c], state.u);
    state.impulse[c] = impulse;
  }
}

}  // namespace

DenseSolution state_of(const DenseProblem& problem, std::vector<Number> impulse) {
  DenseSolution state{std::move(impulse), problem.free, 0};
  for (std::size_t c = 0; c < problem.rows.size(); ++c) {
    push(problem, problem.rows[c], state.impulse[c], state.u);
  }
  for (std::size_t c = 0; c < problem.rows.size(); ++c) {
    const DenseRow& row = problem.rows[c];
    const Number w = gap_after(row, state.u) / diagonal(problem, row);
    const Number lightest =
        std::max({Number(1), problem.inverse_mass[row.a], problem.inverse_mass[row.b]});
    state.violation = std::max(state.violation, lightest * std::abs(std::min(state.impulse[c], w)));
  }
  return state;
}

DenseSolution solve_dense(const DenseProblem& problem) {
  constexpr int sweeps = 1000, rounds = 2000;
  DenseSolution state = state_of(problem, std::vector<Number>(problem.rows.size(), 0));
  for (int round = 0; round < rounds && state.violation > 1e-17L; ++round) {
    for (int k = 0; k < sweeps; ++k) {
      sweep(problem, state);
    }
    state = state_of(problem, state.impulse);
  }
  return state;
}

}  // namespace grainsweep::testing
