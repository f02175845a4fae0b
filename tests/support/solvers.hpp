// The solvers that there are.
#pragma once

#include "engine/scene/spec.hpp"

namespace grainsweep::testing {

inline constexpr Solver all_solvers[] = {Solver::projected_gauss_seidel,
                                         Solver::accelerated_gauss_seidel};

}  // namespace grainsweep::testing
