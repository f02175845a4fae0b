#include "engine/measure/nematic.hpp"

#include <limits>

#include <Eigen/Eigenvalues>

namespace grainsweep {

NematicOrder nematic_order(const std::vector<Vector>& axes) {
  if (axes.empty()) return {std::numeric_limits<double>::quiet_NaN(), Vector::Zero()};
  Matrix sum = Matrix::Zero();
  for (const Vector& axis : axes) {
    sum += axis * axis.transpose();
  }
  const Matrix q = 1.5 * sum / static_cast<double>(axes.size()) - 0.5 * Matrix::Identity();
  const Eigen::SelfAdjointEigenSolver<Matrix> solver(q);  // eigenvalues ascend
  return {solver.eigenvalues()[2], solver.eigenvectors().col(2)};
}

}  // namespace grainsweep
