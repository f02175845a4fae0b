#include "engine/measure/nematic.hpp"

#include <limits>

#include <Eigen/Eigenvalues>

namespace grainsweep {

double nematic_order(const std::vector<Vector>& axes) {
  if (axes.empty()) return std::numeric_limits<double>::quiet_NaN();
  Matrix sum = Matrix::Zero();
  for (const Vector& axis : axes) {
    sum += axis * axis.transpose();
  }
  const Matrix q = 1.5 * sum / static_cast<double>(axes.size()) - 0.5 * Matrix::Identity();
  return Eigen::SelfAdjointEigenSolver<Matrix>(q).eigenvalues()[2];  // they ascend
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
  return {nematic_order(axes[0]), nematic_order(axes[1]), nematic_order(axes[2])};
}

}  // namespace grainsweep
