#include "engine/measure/shape_order.hpp"

#include "engine/measure/nematic.hpp"

namespace grainsweep {

namespace {

/// The axes of the grains of the slab that were axis `number` of the shape's frame.
std::vector<Vector> turned_axes(const PolyhedronBed& bed, const Slab& slab, int number) {
  std::vector<Vector> axes;
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    if (!bed.turns(i) || !slab.contains(bed.position[i].z)) continue;
    axes.emplace_back(bed.pose(i).orientation * Vector(Vector::Unit(number)));
  }
  return axes;
}

}  // namespace

ShapeOrder measure_shape_order(const PolyhedronBed& bed, const std::vector<PairForce>& pair_forces,
                               const Slab& slab) {
  ShapeOrder order;
  double contacts = 0.0, forces = 0.0;
  for (const PairForce& force : pair_forces) {
    if (!slab.contains(force.height)) continue;
    const auto kind = static_cast<std::size_t>(force.constraints - 1);
    order.contact_share[kind] += 1.0;
    order.force_share[kind] += force.magnitude;
    contacts += 1.0;
    forces += force.magnitude;
  }
  for (double& share : order.contact_share) share /= contacts;  // 0 / 0 is NaN
  for (double& share : order.force_share) share /= forces;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    order.nematic[axis] = nematic_order(turned_axes(bed, slab, static_cast<int>(axis))).order;
  }
  return order;
}

}  // namespace grainsweep
