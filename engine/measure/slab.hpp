// The measured slab, and how far a grain reaches.
#pragma once

namespace grainsweep {

/// A horizontal slab of the box, bottom < top, d.
struct Slab {
  double bottom = 0.0;
  double top = 0.0;
  double height() const { return top - bottom; }
  /// Whether a point at height z, d, lies in the slab; at the plane between two adjoining slabs, in
  /// one only.
  bool contains(double z) const { return bottom <= z && z < top; }
};

/// Lowest and highest coordinate along an axis, d.
struct Span {
  double low = 0.0, high = 0.0;
};

}  // namespace grainsweep
