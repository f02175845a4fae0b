// Necks that join grains where they nearly touch. Lengths in d.
//
// A neck is a prism about the normal of a contact. Where a neck of the requested width would meet
// another one or a third grain, both necks, or the one, are made narrower in steps of a fifth.
#pragma once

#include <functional>
#include <vector>

#include "engine/shape/convex_shape.hpp"
#include "runner/export/exported_bed.hpp"

namespace grainsweep {

inline constexpr int neck_sides = 12;

/// Between grain a and grain b, or an image of b; or the flat place of grain a at wall b.
struct Neck {
  std::size_t a = 0, b = 0;
  bool is_wall = false;
  Vector between = Vector::Zero();  ///< from the centre of a to that of b, or of its image
  Vector normal = Vector::UnitZ();  ///< unit, from a to b
  Vector across = Vector::UnitX();  ///< unit, perpendicular to the normal: towards corner 0
  Vector middle = Vector::Zero();   ///< of the axis, from the centre of a, perpendicular to normal
  double asked = 0.0;               ///< radius that was asked for
  double radius = 0.0;              ///< of the circle through its corners
  double low = 0.0, high = 0.0;     ///< ends along the normal from the centre of a
};

/// Where a neck begins or ends on a grain.
struct NeckEnd {
  const Neck* neck = nullptr;
  std::size_t number = 0;  ///< of the neck
  bool is_of_b = false;    ///< whether the grain is its grain b

  /// Unit, along the neck out of the grain.
  Vector outward() const { return is_of_b ? Vector(-neck->normal) : neck->normal; }
};

/// For each of so many grains the ends of necks on it, which refer to the necks.
std::vector<std::vector<NeckEnd>> neck_ends(const std::vector<Neck>& necks, std::size_t grains);

/// Corner k, counter-clockwise seen against the normal, at that height along the normal, from the
/// centre of a.
Vector neck_corner(const Neck& neck, int k, double height);

/// All corners of a neck whose grain a lies at `centre`.
std::vector<Vector> neck_corners(const Neck& neck, const Vector& centre);

/// Whether two convex hulls are further apart than `distance`; near that distance the answer may be
/// no where it should be yes.
bool are_apart(const std::vector<Vector>& points, const std::vector<Vector>& others,
               double distance);

/// Grains as convex hulls of points about their centres, with all that is nearer to the hull than
/// their radius: a sphere is one point with its own radius.
struct GrainBodies {
  std::vector<std::vector<Vector>> points;
  std::vector<double> radii;  ///< 0 for polyhedra
};

/// Makes necks narrower until none meets another one, or a grain that it does not join; `fit` sets
/// the ends of a neck after its radius. Removes those that would be narrower than a tenth of the
/// requested radius, or for spheres than a thousandth, which happens only where grains overlap.
void narrow(const ExportedBed& exported, const GrainBodies& grains,
            const std::function<void(Neck&)>& fit, std::vector<Neck>& necks);

}  // namespace grainsweep
