// components.csv: what each component of a mixture does, a row for each pair of components.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "runner/tables/groups.hpp"
#include "runner/tables/units.hpp"

namespace grainsweep {

/// A component, and how one of its grains touches those of another, or of its own.
struct ComponentLine {
  std::size_t component = 0, other = 0;  ///< from 1
  std::string name, other_name;          ///< as component_names has them
  Spread grains, packed, slab_share, solid_fraction, coordination, coordination_with_walls;
  std::array<Spread, 3> nematic;
  Spread neighbours;
  Spread contacts;                      ///< those that join the two, as a share of all in the slab
  std::array<Spread, 3> contact_kinds;  ///< of those, the shares at a point, along a line, over an
                                        ///< area
};

/// Components of the grains of a group; 0 if they are no mixture or no packing has settled.
std::size_t components_of(const Group& group);

/// Over the settled packings of a group; empty if its grains are no mixture.
std::vector<ComponentLine> mean_components(const Group& group);

CurveTable components_table(const Varied& varied, const GivenUnits& units = {});

}  // namespace grainsweep
