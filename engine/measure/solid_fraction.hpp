// Solid fraction of horizontal slabs, from exact volumes of their parts of each grain.
#pragma once

#include "engine/scene/bed.hpp"
#include "engine/scene/shape_bed.hpp"

namespace grainsweep {

/// A horizontal slab of the box, bottom < top, d.
struct Slab {
  double bottom = 0.0;
  double top = 0.0;
  double height() const { return top - bottom; }
};

/// Volume of the part of a sphere that lies between two parallel planes at signed distances
/// `low` < `high` from its centre, d^3:  pi (r^2 t - t^3 / 3) between the clamped limits.
double sphere_slab_volume(double radius, double low, double high);

/// Solid volume in the slab over the slab's volume. The slab must have a positive height.
double solid_fraction(const SphereBed& bed, const Slab& slab);
double solid_fraction(const ShapeBed& bed, const Slab& slab);

/// Height of the free surface, d: the median, over floor columns about d wide, of the highest point
/// of the grains whose centres stand above the column. 0 for an empty bed.
double surface_height(const SphereBed& bed);
double surface_height(const ShapeBed& bed);

}  // namespace grainsweep
