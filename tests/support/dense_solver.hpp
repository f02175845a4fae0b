// Oracle of the solvers: the dual problem of one step, solved row by row by
// projected Gauss-Seidel in long double until its optimality conditions hold.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/dynamics/solve.hpp"
#include "engine/rows/sphere_contacts.hpp"
#include "tests/support/named_contacts.hpp"

namespace grainsweep::testing {

using Number = long double;

/// One constraint gap + normal . (u_b - u_a) >= 0.
struct DenseRow {
  std::size_t a, b;
  Number normal[3];
  Number gap;
};

struct DenseProblem {
  std::vector<DenseRow> rows;
  std::vector<Number> inverse_mass;  ///< of each entry of the bed
  std::vector<Number> free;          ///< 3 components of each entry
};

struct DenseSolution {
  std::vector<Number> impulse;  ///< of each row
  std::vector<Number> u;        ///< 3 components of each entry
  Number violation;  ///< largest |min(p, w / A)| over the rows, in masses of grains lighter than 1
};

/// The problem that `solve` is given, as written in the rows that are not void.
template <class Real>
DenseProblem dense_problem(const SphereBed& bed, const SphereContacts<Real>& contacts,
                           const std::vector<Record<Real>>& free) {
  DenseProblem problem;
  visit_rows(bed, contacts, [&](const RowBlock<Real>& r, std::size_t k, Real) {
    problem.rows.push_back({static_cast<std::size_t>(r.a(k)),
                            static_cast<std::size_t>(r.b(k)),
                            {r.normal_x[k], r.normal_y[k], r.normal_z[k]},
                            r.gap[k]});
  });
  for (const Record<Real>& record : free) {
    problem.inverse_mass.push_back(record.w);
    problem.free.insert(problem.free.end(), {record.x, record.y, record.z});
  }
  return problem;
}

/// Motion and violation that given impulses lead to.
DenseSolution state_of(const DenseProblem& problem, std::vector<Number> impulse);

/// The solution, to a violation below 1e-17 or after two million sweeps.
DenseSolution solve_dense(const DenseProblem& problem);

}  // namespace grainsweep::testing
