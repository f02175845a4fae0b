// Dense fronts of a sparse Cholesky factorisation; see engine/exact/stiffness.hpp.
//
// A front is a symmetric matrix, its lower triangle by columns. Columns are `stride` numbers apart,
// a multiple of block_width; those beyond the rows are 0, and what lies above the diagonal has no
// meaning.
#pragma once

#include <cstddef>

namespace grainsweep {

template <class Real>
struct FrontKernels {
  /// Eliminates the first `columns` of a front: they become columns of its Cholesky factor, the
  /// others what elimination leaves of them. False if a pivot is not positive.
  bool (*factor)(Real* front, std::size_t rows, std::size_t columns, std::size_t stride);
  /// x = L^-1 x, for the columns of a factor: as many entries of x are solved for, the rest is
  /// changed accordingly. x has room for `stride` numbers, of which those beyond `rows` are 0.
  void (*solve_forward)(const Real* factor, std::size_t rows, std::size_t columns,
                        std::size_t stride, Real* x);
  /// x = L^-T x: as many entries of x are solved for from the rest.
  void (*solve_backward)(const Real* factor, std::size_t rows, std::size_t columns,
                         std::size_t stride, Real* x);
};

}  // namespace grainsweep
