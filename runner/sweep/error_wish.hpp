// The accuracy that people request of the means of a group, and of what is fitted to them.
#pragma once

namespace grainsweep {

/// Every group that grows has so many packings before its scatter counts.
inline constexpr int first_replicates = 6;

/// Largest error of the means that is requested; 0: none is.
struct ErrorWish {
  double solid_fraction = 0.0;
  double coordination = 0.0;

  bool is_given() const { return solid_fraction > 0.0 || coordination > 0.0; }
};

/// Largest error of what is fitted to a family, phi = phi_bulk - C / W and Z = Z_bulk - C_Z / W,
/// that is requested; 0: none is.
struct FitWish {
  double phi_bulk = 0.0;
  double c = 0.0;  ///< d
  double z_bulk = 0.0;
  double c_z = 0.0;  ///< d

  bool is_given() const { return phi_bulk > 0.0 || c > 0.0 || z_bulk > 0.0 || c_z > 0.0; }
};

}  // namespace grainsweep
