#include "engine/exact/stiffness.hpp"

#include <algorithm>

namespace grainsweep {

namespace {

/// Forces of a spring for its ways, d.
Matrix matrix_of(const Spring& spring) {
  const Vector& along = spring.along;
  Matrix matrix = ((spring.stiffness - spring.across) * along) * along.transpose();
  matrix.diagonal().array() += spring.across;
  return matrix;
}

/// Adds a matrix to the 3 x 3 block of grains i >= j of a front.
template <class Real>
void add_block(Real* front, std::size_t stride, std::size_t i, std::size_t j,
               const Matrix& matrix) {
  for (std::size_t q = 0; q < 3; ++q) {
    Real* column = front + (3 * j + q) * stride + 3 * i;
    for (std::size_t p = 0; p < 3; ++p) {
      column[p] +=
          static_cast<Real>(matrix(static_cast<Eigen::Index>(p), static_cast<Eigen::Index>(q)));
    }
  }
}

}  // namespace

void StiffnessFactors::analyse(std::span<const Record<double>> centres,
                               const std::vector<Spring>& springs) {
  std::vector<GrainPair> pairs;
  for (const Spring& spring : springs) {
    if (spring.b != Spring::fixed) pairs.push_back({spring.a, spring.b});
  }
  tree_ = dissect(centres, pairs);
  fronts_.assign(tree_.nodes.size(), {});
  for (std::size_t k = 0; k < springs.size(); ++k) {
    const Spring& spring = springs[k];
    const auto a = static_cast<std::size_t>(spring.a), b = static_cast<std::size_t>(spring.b);
    const bool a_first = spring.b == Spring::fixed || tree_.place[a] < tree_.place[b];
    fronts_[static_cast<std::size_t>(tree_.node_of[a_first ? a : b])].springs.push_back(
        {k, spring.a, spring.b});
  }
  std::vector<std::int32_t> place(centres.size(), 0);  // of each grain in the front at work
  std::size_t size = 0;
  for (std::size_t node = 0; node < fronts_.size(); ++node) {
    Front& front = fronts_[node];
    front.columns = 3 * tree_.nodes[node].grains.size();
    front.rows = 3 * tree_.nodes[node].size();
    front.stride = (front.rows + block_width - 1) / block_width * block_width;
    front.factor = size;
    size += front.columns * front.stride;
    std::int32_t next = 0;
    for (const auto* grains : {&tree_.nodes[node].grains, &tree_.nodes[node].border}) {
      for (const std::int32_t grain : *grains) place[static_cast<std::size_t>(grain)] = next++;
    }
    for (PlacedSpring& spring : front.springs) {
      spring.a = place[static_cast<std::size_t>(spring.a)];
      if (spring.b != Spring::fixed) spring.b = place[static_cast<std::size_t>(spring.b)];
    }
    for (const std::int32_t child : tree_.nodes[node].children) {
      if (child == EliminationNode::none) continue;
      const auto of = static_cast<std::size_t>(child);
      for (const std::int32_t grain : tree_.nodes[of].border) {
        fronts_[of].at_parent.push_back(place[static_cast<std::size_t>(grain)]);
      }
    }
  }
}

template <class Real>
void StiffnessFactors::allocate(Numbers<Real>& numbers) {
  std::size_t size = 0;
  for (const Front& front : fronts_) {
    size = std::max(size, front.factor + front.rows * front.stride);
  }
  numbers.factors.resize(size);
  numbers.left.resize(fronts_.size());
}

double StiffnessFactors::operations() const {
  double sum = 0.0;
  for (const Front& front : fronts_) sum += operations_of(front);
  return sum;
}

/// A lower triangle, column by column.
double StiffnessFactors::operations_of(const Front& front) {
  const auto rows = static_cast<double>(front.rows),
             left = rows - static_cast<double>(front.columns);
  return (rows * rows * rows - left * left * left) / 6.0;
}

template <class Real>
bool StiffnessFactors::factor(const std::vector<Spring>& springs, const std::vector<double>& ground,
                              const std::function<bool()>& keep_going) {
  const FrontKernels<Real>& kernels = kernels_of<Real>(*kernels_).fronts;
  Numbers<Real> own = std::move(numbers<Real>());
  numbers_ = {};  // factors of the other type would take as much memory again
  allocate(own);
  double since = 0.0;
  for (std::size_t node = 0; node < fronts_.size(); ++node) {
    const Front& front = fronts_[node];
    since += operations_of(front);
    if (since > asked_after_) {
      if (!keep_going()) return false;
      since = 0.0;
    }
    gather(node, springs, ground, own);
    if (!kernels.factor(own.matrix_of(front), front.rows, front.columns, front.stride))
      return false;
    hand_on(front, own.matrix_of(front), own.left[node]);
  }
  numbers<Real>() = std::move(own);
  return true;
}

template <class Real>
void StiffnessFactors::gather(std::size_t node, const std::vector<Spring>& springs,
                              const std::vector<double>& ground, Numbers<Real>& numbers) {
  const Front& front = fronts_[node];
  Real* matrix = numbers.matrix_of(front);
  for (std::size_t j = 0; j < front.rows; ++j) {
    const std::size_t first = j / block_width * block_width;
    std::fill_n(matrix + j * front.stride + first, front.stride - first, Real(0));
  }
  std::size_t diagonal = 0;
  for (const std::int32_t grain : tree_.nodes[node].grains) {
    for (int q = 0; q < 3; ++q, diagonal += front.stride + 1) {
      matrix[diagonal] = static_cast<Real>(ground[static_cast<std::size_t>(grain)]);
    }
  }
  for (const PlacedSpring& placed : front.springs) {
    const Matrix spring = matrix_of(springs[placed.spring]);
    const auto a = static_cast<std::size_t>(placed.a);
    add_block(matrix, front.stride, a, a, spring);
    if (placed.b == Spring::fixed) continue;
    const auto b = static_cast<std::size_t>(placed.b);
    add_block(matrix, front.stride, b, b, spring);
    add_block(matrix, front.stride, std::max(a, b), std::min(a, b), -spring);
  }
  for (const std::int32_t child : tree_.nodes[node].children) {
    if (child != EliminationNode::none) {
      const auto at = static_cast<std::size_t>(child);
      add_left(fronts_[at], numbers.left[at], matrix, front.stride);
    }
  }
}

template <class Real>
void StiffnessFactors::add_left(const Front& child, const std::vector<Real>& left, Real* matrix,
                                std::size_t stride) {
  const std::size_t size = child.rows - child.columns;
  for (std::size_t j = 0; j < size; ++j) {
    const std::size_t column = 3 * static_cast<std::size_t>(child.at_parent[j / 3]) + j % 3;
    Real* to = matrix + column * stride;
    const Real* from = left.data() + j * size;
    for (std::size_t i = j / 3; i < child.at_parent.size(); ++i) {
      const auto row = 3 * static_cast<std::size_t>(child.at_parent[i]);
      for (std::size_t p = 0; p < 3; ++p) to[row + p] += from[3 * i + p];
    }
  }
}

template <class Real>
void StiffnessFactors::hand_on(const Front& front, const Real* matrix, std::vector<Real>& left) {
  const std::size_t size = front.rows - front.columns;
  left.resize(size * size);
  for (std::size_t j = 0; j < size; ++j) {
    const Real* column = matrix + (front.columns + j) * front.stride + front.columns;
    std::copy(column + j, column + size, left.data() + j * size + j);
  }
}

template <class Real>
void StiffnessFactors::solve(std::vector<Vector>& x) {
  const FrontKernels<Real>& kernels = kernels_of<Real>(*kernels_).fronts;
  for (std::size_t node = 0; node < fronts_.size(); ++node) {
    solve_front(node, kernels.solve_forward, x, numbers<Real>());
  }
  for (std::size_t node = fronts_.size(); node-- > 0;) {
    solve_front(node, kernels.solve_backward, x, numbers<Real>());
  }
}

template <class Real, class Solve>
void StiffnessFactors::solve_front(std::size_t node, Solve solve_columns, std::vector<Vector>& x,
                                   Numbers<Real>& numbers) {
  const Front& front = fronts_[node];
  const EliminationNode& grains = tree_.nodes[node];
  const auto visit = [&](auto move) {
    Real* at = numbers.at_front.data();
    for (const auto* part : {&grains.grains, &grains.border}) {
      for (const std::int32_t grain : *part) {
        move(x[static_cast<std::size_t>(grain)], at);
        at += 3;
      }
    }
  };
  const auto in_type = [](double number) { return static_cast<Real>(number); };
  numbers.at_front.assign(front.stride, Real(0));
  visit([&](const Vector& from, Real* to) {
    std::transform(from.data(), from.data() + 3, to, in_type);
  });
  solve_columns(numbers.factors.data() + front.factor, front.rows, front.columns, front.stride,
                numbers.at_front.data());
  visit([](Vector& to, const Real* from) { std::copy_n(from, 3, to.data()); });
}

template bool StiffnessFactors::factor<float>(const std::vector<Spring>&,
                                              const std::vector<double>&,
                                              const std::function<bool()>&);
template bool StiffnessFactors::factor<double>(const std::vector<Spring>&,
                                               const std::vector<double>&,
                                               const std::function<bool()>&);
template void StiffnessFactors::solve<float>(std::vector<Vector>&);
template void StiffnessFactors::solve<double>(std::vector<Vector>&);

}  // namespace grainsweep
