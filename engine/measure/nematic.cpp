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

std::array<double, 3> nematic_orders(const PolyhedronBed& bed,
                                     const std::vector<std::size_t>& grains) {
  std::array<std::vector<Vector>, 3> axes;
  for (const std::size_t grain : grains) {
    if (!bed.turns(grain)) continue;
    const Quaternion orientation = bed.given_orientation(grain);
    for (int axis = 0; axis < 3; ++axis) {
      axes[static_cast<std::size_t>(axis)].emplace_back(orientation * Vector(Vector::Unit(axis)));
    }
  }
  return {nematic_order(axes[0]).order, nematic_order(axes[1]).order, nematic_order(axes[2]).order};
}

}  // namespace grainsweep
