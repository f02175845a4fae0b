#include "engine/dynamics/balance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/SparseCholesky>

#include "engine/dynamics/dissection.hpp"
#include "engine/rows/lanes.hpp"

namespace grainsweep {

namespace {

using SparseMatrix = Eigen::SparseMatrix<double>;

// Pivots of the scaled matrix are near 1; one this small means two ways to carry the bed.
constexpr double least_pivot = 1e-10;

/// Three numbers per grain, grain after grain.
Eigen::Index first_force(std::size_t grain) { return 3 * static_cast<Eigen::Index>(grain); }
Eigen::Index forces_of(const SphereBed& bed) { return first_force(bed.grains()); }

/// The rows of `contacts` in f64, measured anew.
template <class Real>
std::vector<RowBlock<double>> rows_in_f64(const SphereBed& bed, const Kernels& kernels,
                                          const SphereContacts<Real>& contacts) {
  SphereContacts<double> measured;
  measured.pair_blocks = contacts.pair_blocks;
  measured.walls = contacts.walls;
  for (const RowBlock<Real>& from : contacts.rows) {
    RowBlock<double>& to = measured.rows.emplace_back();
    for (std::size_t lane = 0; lane < block_width; ++lane) {
      to.set_grains(lane, from.a(lane), from.b(lane));
    }
  }
  update_gaps(bed, kernels, 1.0, measured);
  return measured.rows;
}

/// Adds the three numbers of one side of a contact to column `column` of M^-1/2 H.
void add_side(const SphereBed& bed, const RowBlock<double>& r, std::size_t lane, double sign,
              int column, std::vector<Eigen::Triplet<double>>& entries) {
  const std::int32_t grain = sign > 0.0 ? r.b(lane) : r.a(lane);
  if (grain >= bed.wall()) {
    return;
  }
  const double scale = sign * std::sqrt(bed.motion[static_cast<std::size_t>(grain)].w);
  entries.emplace_back(3 * grain, column, scale * r.normal_x[lane]);
  entries.emplace_back(3 * grain + 1, column, scale * r.normal_y[lane]);
  entries.emplace_back(3 * grain + 2, column, scale * r.normal_z[lane]);
}

/// Where grain a of a row touches its other side.
ContactNode node_of(const SphereBed& bed, const RowBlock<double>& r, std::size_t lane) {
  const Record<double>& a = bed.position[static_cast<std::size_t>(r.a(lane))];
  return {
      {a.x + a.w * r.normal_x[lane], a.y + a.w * r.normal_y[lane], a.z + a.w * r.normal_z[lane]},
      r.a(lane),
      r.b(lane) < bed.wall() ? r.b(lane) : ContactNode::no_grain};
}

/// M^-1/2 H, a column per force-bearing contact, in an order that suits its factors.
template <class Real>
SparseMatrix contact_matrix(const SphereBed& bed, const Kernels& kernels, double dt,
                            const SphereContacts<Real>& contacts) {
  const std::vector<RowBlock<double>> rows = rows_in_f64(bed, kernels, contacts);
  std::vector<ContactNode> nodes;
  std::vector<BlockLane> lanes;
  visit_force_bearing(contacts, dt, [&](std::size_t block, std::size_t lane, double) {
    nodes.push_back(node_of(bed, rows[block], lane));
    lanes.push_back({block, lane});
  });
  std::vector<Eigen::Triplet<double>> entries;
  int columns = 0;
  for (const std::int32_t contact : dissect(nodes, bed.grains())) {
    const BlockLane at = lanes[static_cast<std::size_t>(contact)];
    add_side(bed, rows[at.block], at.lane, 1.0, columns, entries);
    add_side(bed, rows[at.block], at.lane, -1.0, columns, entries);
    ++columns;
  }
  SparseMatrix matrix(forces_of(bed), columns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

/// M^-1/2 times the force that carries each grain's weight.
Eigen::VectorXd carried_weights(const SphereBed& bed) {
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(forces_of(bed));
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    weights[first_force(i) + 2] = 1.0 / std::sqrt(bed.motion[i].w);
  }
  return weights;
}

/// Largest and mean net force on a grain, in its own weight.
void set_unbalance(const Eigen::VectorXd& scaled, const SphereBed& bed, ForceBalance& balance) {
  double sum = 0.0;
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    const double net = scaled.segment<3>(first_force(i)).norm() * std::sqrt(bed.motion[i].w);
    balance.unbalance_max = std::max(balance.unbalance_max, net);
    sum += net;
  }
  balance.unbalance_mean = sum / static_cast<double>(std::max<std::size_t>(bed.grains(), 1));
}

}  // namespace

template <class Real>
ForceBalance balance_forces(const SphereBed& bed, const Kernels& kernels, double dt,
                            const SphereContacts<Real>& contacts) {
  const SparseMatrix h = contact_matrix(bed, kernels, dt, contacts);
  const Eigen::VectorXd weights = carried_weights(bed);
  ForceBalance balance;
  if (h.cols() == 0) {
    set_unbalance(weights, bed, balance);
    return balance;
  }
  const SparseMatrix a = h.transpose() * h;
  const Eigen::SimplicialLDLT<SparseMatrix, Eigen::Lower, Eigen::NaturalOrdering<int>> factors(a);
  const Eigen::VectorXd pivots = factors.vectorD();
  balance.unique =
      factors.info() == Eigen::Success && pivots.minCoeff() > least_pivot * pivots.maxCoeff();
  if (balance.unique) {
    const Eigen::VectorXd forces = factors.solve(h.transpose() * weights);
    balance.least_force = forces.minCoeff();
    set_unbalance(weights - h * forces, bed, balance);
  } else {
    balance.least_force = balance.unbalance_max = balance.unbalance_mean =
        std::numeric_limits<double>::quiet_NaN();
  }
  return balance;
}

template ForceBalance balance_forces(const SphereBed&, const Kernels&, double,
                                     const SphereContacts<float>&);
template ForceBalance balance_forces(const SphereBed&, const Kernels&, double,
                                     const SphereContacts<double>&);

}  // namespace grainsweep
