#include "engine/dynamics/rank.hpp"

#include <array>
#include <cmath>
#include <vector>

#include <Eigen/SparseCholesky>

#include "engine/dynamics/dissection.hpp"
#include "engine/dynamics/rest.hpp"
#include "engine/narrow/constraints.hpp"

namespace grainsweep {

namespace {

using SparseMatrix = Eigen::SparseMatrix<double>;

// Eigenvalues of the scaled matrix are near 1, those of dependent constraints 0 but for rounding.
constexpr double least_eigenvalue = 1e-10;

/// A force of 1 between two sides, along its normal: the force on each of them and, on polyhedra,
/// the torque, times M^-1/2.
struct ForceColumn {
  std::int32_t a = 0, b = 0;  ///< as of ForceContact
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
    if (is_held_by(bed, c)) continue;
    const auto a = static_cast<std::size_t>(c.a), b = static_cast<std::size_t>(c.b);
    const Record<double>& p = bed.position[a];
    ForceColumn column{c.a, c.b};
    Vector normal;
    if (bed.is_grain(c.b)) {
      normal = nearest_difference(bed, a, b).normalized();
      set_force(bed.motion[b].w, free_part(bed, b, normal), column.on_b);
    } else {
      const UnitVector n = bed.walls[b - bed.grains()].normal(p.x, p.y, p.z);
      normal = -Vector(n.x, n.y, n.z);
    }
    set_force(bed.motion[a].w, free_part(bed, a, -normal), column.on_a);
    columns.push_back(column);
  }
  return columns;
}

/// The column of a point of a contact.
ForceColumn column_of(const PolyhedronBed& bed, const PolyhedronContact& c,
                      const Vector& position) {
  const auto a = static_cast<std::size_t>(c.a);
  const Vector normal = bed.pose(a).orientation * c.normal;
  ForceColumn column{c.a, c.b};
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

/// For contacts along a line two points, over an area three: more would carry the same forces in
/// many ways.
template <class Real>
std::vector<ForceColumn> force_columns(PolyhedronBed& bed, const ExecutionContext& context,
                                       double dt, const PolyhedronContacts<Real>& contacts) {
  std::vector<ForceColumn> columns;
  for (const ContactList& found : closed_contacts(bed, context, dt, contacts)) {
    for (const PolyhedronContact& c : found.contacts) {
      const auto points = constraint_points(found.points.data() + c.first, c.count, closed_gap);
      for (int k = 0; k < points.count; ++k) {
        const ContactPoint& point = *points.point[static_cast<std::size_t>(k)];
        columns.push_back(column_of(bed, c, point.position));
      }
    }
  }
  return columns;
}

// ---- the same for all ----

// Degrees of freedom follow one another, grain after grain.

/// M^-1/2 H, its columns in an order that suits its factors.
template <class Kind>
SparseMatrix contact_matrix(const Bed<Kind>& bed, const std::vector<ForceColumn>& columns) {
  std::vector<GrainPair> contacts;
  contacts.reserve(columns.size());
  for (const ForceColumn& c : columns) contacts.push_back({c.a, bed.is_grain(c.b) ? c.b : c.a});
  std::vector<Eigen::Triplet<double>> entries;
  int place = 0;
  for (const std::int32_t k : elimination_order(bed.centres(), contacts)) {
    const ForceColumn& column = columns[static_cast<std::size_t>(k)];
    const auto add_side = [&](std::int32_t grain, const std::array<double, 6>& side) {
      for (int i = 0; i < Kind::degrees_of_freedom; ++i) {
        entries.emplace_back(Kind::degrees_of_freedom * grain + i, place,
                             side[static_cast<std::size_t>(i)]);
      }
    };
    if (bed.is_grain(column.b)) add_side(column.b, column.on_b);
    add_side(column.a, column.on_a);
    ++place;
  }
  SparseMatrix matrix(Kind::degrees_of_freedom * static_cast<Eigen::Index>(bed.grains()),
                      static_cast<Eigen::Index>(columns.size()));
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace

// By Sylvester's law of inertia as many pivots of A - s are negative as A has eigenvalues below s.
template <class Kind, class Real>
std::int64_t independent_constraints(Bed<Kind>& bed, const ExecutionContext& context, double dt,
                                     const Contacts<Kind, Real>& contacts) {
  const std::vector<ForceColumn> columns = force_columns(bed, context, dt, contacts);
  if (columns.empty()) return 0;
  const SparseMatrix h = contact_matrix(bed, columns);
  const SparseMatrix a = h.transpose() * h;
  Eigen::SimplicialLDLT<SparseMatrix, Eigen::Lower, Eigen::NaturalOrdering<int>> factors;
  factors.setShift(-least_eigenvalue);
  factors.compute(a);
  return (factors.vectorD().array() > 0.0).count();
}

template std::int64_t independent_constraints(SphereBed&, const ExecutionContext&, double,
                                              const SphereContacts<float>&);
template std::int64_t independent_constraints(SphereBed&, const ExecutionContext&, double,
                                              const SphereContacts<double>&);
template std::int64_t independent_constraints(PolyhedronBed&, const ExecutionContext&, double,
                                              const PolyhedronContacts<float>&);
template std::int64_t independent_constraints(PolyhedronBed&, const ExecutionContext&, double,
                                              const PolyhedronContacts<double>&);

}  // namespace grainsweep
