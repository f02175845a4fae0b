#include "engine/dynamics/balance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include <Eigen/SparseCholesky>

#include "engine/dynamics/dissection.hpp"
#include "engine/narrow/constraints.hpp"

namespace grainsweep {

namespace {

using SparseMatrix = Eigen::SparseMatrix<double>;

using Factors = Eigen::SimplicialLDLT<SparseMatrix, Eigen::Lower, Eigen::NaturalOrdering<int>>;

// Pivots of the scaled matrix are near 1; one this small means two ways to carry the bed.
constexpr double min_pivot = 1e-10;
// Added to the diagonal then; what is left unbalanced changes by no more than such a share.
constexpr double regular_share = 1e-8;

bool is_regular(const Factors& factors) {
  const Eigen::VectorXd pivots = factors.vectorD();
  return factors.info() == Eigen::Success && pivots.minCoeff() > min_pivot * pivots.maxCoeff();
}

/// A force of 1 between two sides, along its normal: the force that it is on each of them and, on
/// polyhedra, the torque, times M^-1/2. Columns of one contact carry its force together.
struct ForceColumn {
  std::int32_t a = 0, b = 0;  ///< as of ForceContact
  std::int32_t contact = 0;
  Vector place = Vector::Zero();  ///< d
  std::array<double, 6> on_a{}, on_b{};
};

void set_force(double inverse_mass, const Vector& force, std::array<double, 6>& side) {
  const double root = std::sqrt(inverse_mass);
  side[0] = root * force.x(), side[1] = root * force.y(), side[2] = root * force.z();
}
/// `scaled`: torque about the centre in the grain's frame, over the roots of the moments.
void set_torque(const Vector& scaled, std::array<double, 6>& side) {
  side[3] = scaled.x(), side[4] = scaled.y(), side[5] = scaled.z();
}

// ---- the columns of both kinds of grains, from normals measured anew in f64 ----

template <class Real>
std::vector<ForceColumn> force_columns(const SphereBed& bed, const ExecutionContext& /*context*/,
                                       double dt, const SphereContacts<Real>& contacts) {
  std::vector<ForceColumn> columns;
  for (const ForceContact& c : force_contacts(bed, dt, contacts)) {
    const auto a = static_cast<std::size_t>(c.a), b = static_cast<std::size_t>(c.b);
    const Record<double>& p = bed.position[a];
    ForceColumn column{c.a, c.b, static_cast<std::int32_t>(columns.size())};
    Vector normal;
    if (bed.is_grain(c.b)) {
      normal = nearest_difference(bed, a, b).normalized();
      set_force(bed.motion[b].w, normal, column.on_b);
    } else {
      const UnitVector n = bed.walls[b - bed.grains()].normal(p.x, p.y, p.z);
      normal = -Vector(n.x, n.y, n.z);
    }
    set_force(bed.motion[a].w, -normal, column.on_a);
    column.place = Vector(p.x, p.y, p.z) + p.w * normal;
    columns.push_back(column);
  }
  return columns;
}

/// The column of a point of a contact.
ForceColumn column_of(const PolyhedronBed& bed, const PolyhedronContact& c, std::int32_t contact,
                      const Vector& position) {
  const auto a = static_cast<std::size_t>(c.a);
  const Pose pose = bed.pose(a);
  const Vector normal = pose.orientation * c.normal;
  ForceColumn column{c.a, c.b, contact, pose.centre + pose.orientation * position};
  set_force(bed.motion[a].w, -normal, column.on_a);
  set_torque(-position.cross(c.normal).cwiseQuotient(bed.root_inertia[a]), column.on_a);
  if (bed.is_grain(c.b)) {
    const auto b = static_cast<std::size_t>(c.b);
    const Vector torque = c.pose.turn.transpose() * (position - c.pose.centre).cross(c.normal);
    set_force(bed.motion[b].w, normal, column.on_b);
    set_torque(torque.cwiseQuotient(bed.root_inertia[b]), column.on_b);
  }
  return column;
}

/// Of contacts along a line or over an area two or three points: more would carry the same forces
/// in many ways.
template <class Real>
std::vector<ForceColumn> force_columns(PolyhedronBed& bed, const ExecutionContext& context,
                                       double dt, const PolyhedronContacts<Real>& contacts) {
  std::vector<ForceColumn> columns;
  std::int32_t number = 0;
  for (const ContactList& found : closed_contacts(bed, context, dt, contacts)) {
    for (const PolyhedronContact& c : found.contacts) {
      const auto points = constraint_points(found.points.data() + c.first, c.count, closed_gap);
      for (int k = 0; k < points.count; ++k) {
        const ContactPoint& point = *points.point[static_cast<std::size_t>(k)];
        columns.push_back(column_of(bed, c, number, point.position));
      }
      ++number;
    }
  }
  return columns;
}

// ---- the same for all ----

// Degrees of freedom follow one another, grain after grain.

/// M^-1/2 H, in an order that suits its factors; `columns` are put into it.
template <class Kind>
SparseMatrix contact_matrix(const Bed<Kind>& bed, std::vector<ForceColumn>& columns) {
  std::vector<ContactNode> nodes;
  nodes.reserve(columns.size());
  for (const ForceColumn& c : columns) {
    nodes.push_back({{c.place.x(), c.place.y(), c.place.z()},
                     c.a,
                     bed.is_grain(c.b) ? c.b : ContactNode::no_grain});
  }
  std::vector<ForceColumn> ordered;
  ordered.reserve(columns.size());
  for (const std::int32_t k : dissect(nodes, bed.grains())) {
    ordered.push_back(columns[static_cast<std::size_t>(k)]);
  }
  columns = std::move(ordered);
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const auto add_side = [&](std::int32_t grain, const std::array<double, 6>& side) {
      for (int i = 0; i < Kind::degrees_of_freedom; ++i) {
        entries.emplace_back(Kind::degrees_of_freedom * grain + i, static_cast<int>(k),
                             side[static_cast<std::size_t>(i)]);
      }
    };
    if (bed.is_grain(columns[k].b)) add_side(columns[k].b, columns[k].on_b);
    add_side(columns[k].a, columns[k].on_a);
  }
  SparseMatrix matrix(Kind::degrees_of_freedom * static_cast<Eigen::Index>(bed.grains()),
                      static_cast<Eigen::Index>(columns.size()));
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

/// M^-1/2 times the force that carries each grain's weight.
template <class Kind>
Eigen::VectorXd carried_weights(const Bed<Kind>& bed) {
  const auto grains = static_cast<Eigen::Index>(bed.grains());
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(Kind::degrees_of_freedom * grains);
  for (Eigen::Index i = 0; i < grains; ++i) {
    weights[Kind::degrees_of_freedom * i + 2] =
        1.0 / std::sqrt(bed.motion[static_cast<std::size_t>(i)].w);
  }
  return weights;
}

/// Net torque on a grain over its circumradius, in its own weight.
double net_torque(const SphereBed&, const Eigen::VectorXd&, std::size_t) { return 0.0; }
double net_torque(const PolyhedronBed& bed, const Eigen::VectorXd& scaled, std::size_t grain) {
  const Vector torque = scaled.segment<3>(6 * static_cast<Eigen::Index>(grain) + 3)
                            .cwiseProduct(bed.root_inertia[grain]);
  return torque.norm() * bed.motion[grain].w / bed.circumradius(grain);
}

/// Largest and mean of what is left on a grain, force or torque.
template <class Kind>
void set_unbalance(const Eigen::VectorXd& scaled, const Bed<Kind>& bed, ForceBalance& balance) {
  double sum = 0.0;
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    const auto first = Kind::degrees_of_freedom * static_cast<Eigen::Index>(i);
    const double force = scaled.segment<3>(first).norm() * std::sqrt(bed.motion[i].w);
    const double net = std::max(force, net_torque(bed, scaled, i));
    balance.unbalance_max = std::max(balance.unbalance_max, net);
    sum += net;
  }
  balance.unbalance_mean = sum / static_cast<double>(std::max<std::size_t>(bed.grains(), 1));
}

/// Least force of a contact, the sum over its columns.
double min_of(const std::vector<ForceColumn>& columns, const Eigen::VectorXd& forces) {
  std::map<std::int32_t, double> of_contact;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    of_contact[columns[k].contact] += forces[static_cast<Eigen::Index>(k)];
  }
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [contact, force] : of_contact) least = std::min(least, force);
  return least;
}

}  // namespace

template <class Kind, class Real>
ForceBalance balance_forces(Bed<Kind>& bed, const ExecutionContext& context, double dt,
                            const Contacts<Kind, Real>& contacts) {
  std::vector<ForceColumn> columns = force_columns(bed, context, dt, contacts);
  const SparseMatrix h = contact_matrix(bed, columns);
  const Eigen::VectorXd weights = carried_weights(bed);
  ForceBalance balance;
  if (h.cols() == 0) {
    set_unbalance(weights, bed, balance);
    return balance;
  }
  SparseMatrix a = h.transpose() * h;
  Factors factors(a);
  balance.unique = is_regular(factors);
  if (!balance.unique) {  // what is left is the same for all forces that fit best
    for (Eigen::Index k = 0; k < a.cols(); ++k) a.coeffRef(k, k) += regular_share;
    factors.compute(a);
  }
  const Eigen::VectorXd forces = factors.solve(h.transpose() * weights);
  set_unbalance(weights - h * forces, bed, balance);
  balance.least_force =
      balance.unique ? min_of(columns, forces) : std::numeric_limits<double>::quiet_NaN();
  return balance;
}

template ForceBalance balance_forces(SphereBed&, const ExecutionContext&, double,
                                     const SphereContacts<float>&);
template ForceBalance balance_forces(SphereBed&, const ExecutionContext&, double,
                                     const SphereContacts<double>&);
template ForceBalance balance_forces(PolyhedronBed&, const ExecutionContext&, double,
                                     const PolyhedronContacts<float>&);
template ForceBalance balance_forces(PolyhedronBed&, const ExecutionContext&, double,
                                     const PolyhedronContacts<double>&);

}  // namespace grainsweep
