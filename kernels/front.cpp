// Dense fronts of a sparse Cholesky factorisation: eliminating some columns, and solving with them.
//
// Every number is made by the same operations in the same order whatever the width of a batch is:
// batches run over rows, sums over columns. Only the dot products of solve_backward run over rows,
// in the lanes of a block.
#include <cmath>

#include "kernels/lanes.hpp"
#include "kernels/tables.hpp"

namespace {

// Columns are eliminated from each other in panels, and from all that follow by wide ones: what
// follows, larger than any cache, is read and written a quarter as often.
constexpr std::size_t panel_columns = 16, wide_columns = 64;
// Two batches of rows of so many columns, and what is subtracted from them, are held in registers.
template <class Real>
constexpr std::size_t tile_columns = batch_width<Real> * sizeof(Real) >= 64 ? 8 : 4;

/// A dense matrix by columns.
template <class Real>
struct Columns {
  Real* at;
  std::size_t stride;

  Real* column(std::size_t j) const { return at + j * stride; }
};

/// Eliminates `l` from `j`: rows from j on.
template <class Real>
inline void subtract_column(const Columns<Real>& m, std::size_t l, std::size_t j) {
  constexpr std::size_t width = batch_width<Real>;
  const Real factor = m.column(l)[j];
  const Batch<Real> factors(factor);
  for (std::size_t i = j / width * width; i < m.stride; i += width) {
    (load(m.column(j) + i) - load(m.column(l) + i) * factors).store_unaligned(m.column(j) + i);
  }
}

/// The factor's columns first .. last, from which all columns before have been eliminated. False if
/// a pivot is not positive.
template <class Real>
inline bool factor_panel(const Columns<Real>& m, std::size_t first, std::size_t last) {
  constexpr std::size_t width = batch_width<Real>;
  for (std::size_t j = first; j < last; ++j) {
    for (std::size_t l = first; l < j; ++l) subtract_column(m, l, j);
    const Real pivot = m.column(j)[j];
    if (!(pivot > Real(0))) return false;
    const Batch<Real> inverse(Real(1) / std::sqrt(pivot));
    for (std::size_t i = j / width * width; i < m.stride; i += width) {
      (load(m.column(j) + i) * inverse).store_unaligned(m.column(j) + i);
    }
  }
  return true;
}

/// Eliminates columns first .. last from columns j .. j + tiles, in `batches_of_rows` batches of
/// rows from row i on.
template <std::size_t batches_of_rows, std::size_t tiles, class Real>
inline void eliminate_tile(const Columns<Real>& m, std::size_t first, std::size_t last,
                           std::size_t i, std::size_t j) {
  constexpr std::size_t width = batch_width<Real>;
  Batch<Real> sum[tiles][batches_of_rows];
  for (std::size_t c = 0; c < tiles; ++c) {
    for (std::size_t r = 0; r < batches_of_rows; ++r) {
      sum[c][r] = load(m.column(j + c) + i + r * width);
    }
  }
  for (std::size_t l = first; l < last; ++l) {
    const Real* from = m.column(l);
    Batch<Real> rows[batches_of_rows];
    for (std::size_t r = 0; r < batches_of_rows; ++r) rows[r] = load(from + i + r * width);
    for (std::size_t c = 0; c < tiles; ++c) {
      const Batch<Real> factor(from[j + c]);
      for (std::size_t r = 0; r < batches_of_rows; ++r) sum[c][r] -= rows[r] * factor;
    }
  }
  for (std::size_t c = 0; c < tiles; ++c) {
    for (std::size_t r = 0; r < batches_of_rows; ++r) {
      sum[c][r].store_unaligned(m.column(j + c) + i + r * width);
    }
  }
}

template <std::size_t tiles, class Real>
inline void eliminate_from(const Columns<Real>& m, std::size_t first, std::size_t last,
                           std::size_t j) {
  constexpr std::size_t width = batch_width<Real>, two = 2 * width;
  std::size_t i = j / width * width;
  for (; i + two <= m.stride; i += two) eliminate_tile<2, tiles>(m, first, last, i, j);
  if (i < m.stride) eliminate_tile<1, tiles>(m, first, last, i, j);
}

/// Eliminates columns first .. last from columns j .. end.
template <class Real>
inline void eliminate_columns(const Columns<Real>& m, std::size_t first, std::size_t last,
                              std::size_t j, std::size_t end) {
  for (; j + tile_columns<Real> <= end; j += tile_columns<Real>) {
    eliminate_from<tile_columns<Real>>(m, first, last, j);
  }
  for (; j < end; ++j) eliminate_from<1>(m, first, last, j);
}

/// From each number the columns before its own are subtracted in their order, whatever the widths
/// above.
template <class Real>
bool eliminate(Real* front, std::size_t rows, std::size_t columns, std::size_t stride) {
  const Columns<Real> m{front, stride};
  for (std::size_t first = 0; first < columns; first += wide_columns) {
    const std::size_t last = first + wide_columns < columns ? first + wide_columns : columns;
    for (std::size_t k = first; k < last; k += panel_columns) {
      const std::size_t next = k + panel_columns < last ? k + panel_columns : last;
      if (!factor_panel(m, k, next)) return false;
      eliminate_columns(m, k, next, next, last);
    }
    eliminate_columns(m, first, last, last, rows);
  }
  return true;
}

template <class Real>
void solve_forward(const Real* factor, std::size_t rows, std::size_t columns, std::size_t stride,
                   Real* x) {
  constexpr std::size_t width = batch_width<Real>;
  for (std::size_t j = 0; j < columns; ++j) {
    const Real* column = factor + j * stride;
    x[j] /= column[j];
    std::size_t i = j + 1;
    for (; i < rows && i % block_width != 0; ++i) x[i] -= column[i] * x[j];
    const Batch<Real> solved(x[j]);
    for (; i < rows; i += width) (load(x + i) - load(column + i) * solved).store_unaligned(x + i);
  }
}

template <class Real>
void solve_backward(const Real* factor, std::size_t rows, std::size_t columns, std::size_t stride,
                    Real* x) {
  constexpr std::size_t width = batch_width<Real>;
  for (std::size_t j = columns; j-- > 0;) {
    const Real* column = factor + j * stride;
    Real known = 0;
    std::size_t i = j + 1;
    for (; i < rows && i % block_width != 0; ++i) known += column[i] * x[i];
    LaneSums<Real> sums(0);
    for (; i < rows; i += block_width) {
      for (std::size_t k = 0; k < batches<Real>; ++k) {
        sums.part[k] += load(column + i + k * width) * load(x + i + k * width);
      }
    }
    x[j] = (x[j] - (known + sums.sum())) / column[j];
  }
}

}  // namespace

namespace grainsweep::GRAINSWEEP_ISA_NAME {

extern const FrontKernels<float> front_kernels_f32 = {eliminate<float>, solve_forward<float>,
                                                      solve_backward<float>};
extern const FrontKernels<double> front_kernels_f64 = {eliminate<double>, solve_forward<double>,
                                                       solve_backward<double>};

}  // namespace grainsweep::GRAINSWEEP_ISA_NAME
