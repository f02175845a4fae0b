// The curves of a packing, by far the most of what is measured of it: kept with its grains, not in
// the journal, and read where a table needs them.
#pragma once

#include <string>
#include <string_view>

#include "engine/results.hpp"

namespace grainsweep {

/// Members as of PackingResult and its Order; empty if nothing was measured.
struct Curves {
  Profile profile_y;
  Profile profile_z;
  Curve pair_correlation;
  Curve force_density;
};

Curves curves_of(const PackingResult& result);
void set_curves(Curves&& curves, PackingResult& result);

/// Appends profile_y, profile_z, pair_correlation and force_density, little-endian. A profile is
/// f64 bin width, u64 number of bins and per bin f64 large, small, u64 large_grains, small_grains,
/// neighbours, walls; a curve f64 bin width, u64 number of values and f64 values.
void put_curves(std::string& bytes, const Curves& curves);

/// Takes what put_curves appended off the front. Throws std::length_error if it ends too early.
Curves take_curves(std::string_view& bytes);

}  // namespace grainsweep
