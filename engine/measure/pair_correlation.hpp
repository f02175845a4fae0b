// Radial distribution g(r): how many pairs of grains stand a distance r apart, over how many would
// if grains were points at random in the same region.
//
// The region is the measured slab, along walled axes as far as centres reach. Points at random in a
// region of edges E have N (N - 1) / 2 pairs, of which the share
//   1 / V^2  times the integral over h, r1 < |h| < r2, of the product of (E_i - |h_i|)
// is between r1 and r2 apart, with E_i in place of E_i - |h_i| along periodic axes. Averaged over
// directions the product is a polynomial in |h|, since the means of |u_i|, |u_i u_j| and
// |u_x u_y u_z| over unit vectors are 1/2, 2 / (3 pi) and 1 / (4 pi). So walls, slab and a narrow
// gap need no correction of their own (the isotropised set covariance; Ohser 1983). In a tube the
// region is a cylinder, whose set covariance is the area that two discs share times E_z - |h_z|;
// its mean over directions is a quadrature.
#pragma once

#include "engine/measure/slab.hpp"
#include "engine/results.hpp"
#include "engine/scene/bed.hpp"

namespace grainsweep {

/// g in bins of `bin_width` up to `largest`, d, or as far as the region allows: half a period, and
/// its edge along other axes; in a tube its height. All grains alike, whatever their size. Empty
/// with fewer than two grains.
Curve pair_correlation(const Grains& bed, const Slab& slab, double bin_width, double largest);

}  // namespace grainsweep
