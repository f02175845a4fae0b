#include "engine/measure/shape_order.hpp"

#include "engine/measure/nematic.hpp"

namespace grainsweep {

namespace {

std::vector<std::size_t> grains_in(const PolyhedronBed& bed, const Slab& slab) {
  std::vector<std::size_t> grains;
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    if (slab.contains(bed.position[i].z)) grains.push_back(i);
  }
  return grains;
}

}  // namespace

ShapeOrder measure_shape_order(const PolyhedronBed& bed, const std::vector<PairForce>& pair_forces,
                               const std::vector<ForceLine>& lines, const Slab& slab) {
  ShapeOrder order;
  double contacts = 0.0, forces = 0.0;
  for (std::size_t k = 0; k < pair_forces.size(); ++k) {
    const PairForce& force = pair_forces[k];
    if (!slab.contains(force.height)) continue;
    const auto kind = static_cast<std::size_t>(lines[k].constraints - 1);
    order.contact_share[kind] += 1.0;
    order.force_share[kind] += force.magnitude;
    contacts += 1.0;
    forces += force.magnitude;
  }
  for (double& share : order.contact_share) share /= contacts;  // 0 / 0 is NaN
  for (double& share : order.force_share) share /= forces;
  order.nematic = nematic_orders(bed, grains_in(bed, slab));
  return order;
}

}  // namespace grainsweep
