#include "engine/measure/components.hpp"

#include <cstddef>

#include "engine/measure/nematic.hpp"
#include "engine/measure/solid_fraction.hpp"

namespace grainsweep {

namespace {

using Components = std::vector<ComponentMeasure>;

bool has_centre_in(const PolyhedronBed& bed, const Slab& slab, std::size_t grain) {
  return slab.contains(bed.position[grain].z);
}

/// Numbers of grains and their volumes, d^3, in the places of shares.
void add_volumes(const PolyhedronBed& bed, const Slab& slab, Components& components) {
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    ComponentMeasure& own = components[bed.component(i)];
    ++own.grains;
    own.slab_grains += has_centre_in(bed, slab, i) ? 1 : 0;
    own.packed += volume_of(bed, i);
    own.slab_share += volume_in(slab, bed, i);
  }
}

/// From volumes to shares and solid fractions.
void divide_volumes(double slab_volume, Components& components) {
  double packed = 0.0, in_slab = 0.0;
  for (const ComponentMeasure& one : components) {
    packed += one.packed;
    in_slab += one.slab_share;
  }
  for (ComponentMeasure& one : components) {
    one.solid_fraction = one.slab_share / slab_volume;
    one.packed /= packed;
    one.slab_share /= in_slab;  // 0 / 0 is NaN
  }
}

void count_neighbours(const PolyhedronBed& bed, const Touching& touching, const Slab& slab,
                      double gap_tolerance, Components& components) {
  for (ComponentMeasure& one : components) one.neighbours.assign(components.size(), 0.0);
  visit_touching(
      touching, gap_tolerance,
      [&](std::size_t grain, std::size_t other) {
        if (!has_centre_in(bed, slab, grain)) return;
        components[bed.component(grain)].neighbours[bed.component(other)] += 1.0;
      },
      [&](std::size_t grain) {
        if (!has_centre_in(bed, slab, grain)) return;
        components[bed.component(grain)].coordination_with_walls += 1.0;
      });
  for (ComponentMeasure& one : components) {
    const auto grains = static_cast<double>(one.slab_grains);
    for (double& neighbours : one.neighbours) {
      one.coordination += neighbours / grains;
      neighbours /= grains;
    }
    one.coordination_with_walls = one.coordination + one.coordination_with_walls / grains;
  }
}

void count_contacts(const PolyhedronBed& bed, const std::vector<PairForce>& pair_forces,
                    const std::vector<ForceLine>& lines, const Slab& slab, Components& components) {
  for (ComponentMeasure& one : components) one.contacts.resize(components.size());
  for (std::size_t k = 0; k < pair_forces.size(); ++k) {
    const PairForce& force = pair_forces[k];
    if (!slab.contains(force.height)) continue;
    const std::size_t a = bed.component(static_cast<std::size_t>(force.a));
    const std::size_t b = bed.component(static_cast<std::size_t>(force.b));
    const auto kind = static_cast<std::size_t>(lines[k].constraints - 1);
    ++components[a].contacts[b][kind];
    if (a != b) ++components[b].contacts[a][kind];
  }
}

/// The grains of the slab, by component.
std::vector<std::vector<std::size_t>> grains_of_components(const PolyhedronBed& bed,
                                                           const Slab& slab) {
  std::vector<std::vector<std::size_t>> grains(bed.shapes.size());
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    if (has_centre_in(bed, slab, i)) grains[bed.component(i)].push_back(i);
  }
  return grains;
}

}  // namespace

std::vector<ComponentMeasure> measure_components(const PolyhedronBed& bed, const Touching& touching,
                                                 const std::vector<PairForce>& pair_forces,
                                                 const std::vector<ForceLine>& lines,
                                                 const Slab& slab, double gap_tolerance) {
  Components components(bed.components.empty() ? 0 : bed.shapes.size());
  if (components.empty()) return components;
  add_volumes(bed, slab, components);
  divide_volumes(bed.box.floor_area() * slab.height(), components);
  count_neighbours(bed, touching, slab, gap_tolerance, components);
  count_contacts(bed, pair_forces, lines, slab, components);
  const auto grains = grains_of_components(bed, slab);
  for (std::size_t k = 0; k < components.size(); ++k) {
    components[k].nematic = nematic_orders(bed, grains[k]);
  }
  return components;
}

}  // namespace grainsweep
