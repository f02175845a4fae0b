// Solid fraction of horizontal slabs, from the exact volumes of the parts of grains in them.
#pragma once

#include "engine/measure/slab.hpp"
#include "engine/scene/bed.hpp"

namespace grainsweep {

/// Lowest and highest coordinate of a grain along `axis` of the box (0 x, 1 y, 2 z), d.
Span span_of(const SphereBed& bed, std::size_t grain, int axis);
Span span_of(const PolyhedronBed& bed, std::size_t grain, int axis);

/// Volume of the part of a sphere that lies between two parallel planes at signed distances
/// `low` < `high` from its centre, d^3:  pi (r^2 t - t^3 / 3) between the clamped limits.
double sphere_slab_volume(double radius, double low, double high);

/// Volume of the part of a grain in the slab, which may be endless, d^3.
double volume_in(const Slab& slab, const SphereBed& bed, std::size_t grain);
double volume_in(const Slab& slab, const PolyhedronBed& bed, std::size_t grain);

/// Solid volume in the slab over the slab's volume. The slab must have a positive height.
template <class Kind>
double solid_fraction(const Bed<Kind>& bed, const Slab& slab);

/// Share of the grains of a radius below `small_below` in the slab's solid volume; NaN if it holds
/// none.
template <class Kind>
double small_share(const Bed<Kind>& bed, const Slab& slab, double small_below);

/// Height of the free surface, d: the median, over floor columns about d wide, or as wide as the
/// grains if they are larger (mean diameter of spheres of the same volumes, weighted by volume), of
/// the highest point of the grains whose centres stand above the column. Of an even number of
/// columns the higher of the two in the middle counts. 0 if most columns have no grain.
template <class Kind>
double surface_height(const Bed<Kind>& bed);

}  // namespace grainsweep
