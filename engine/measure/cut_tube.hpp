// Volumes that an upright round cylinder, and two horizontal planes, cut from a grain.
//
// A plane at height z cuts a sphere in a disc and a polyhedron in a convex polygon. The area that
// either shares with the disc of the cylinder is known in closed form; it is integrated over z
// between the heights where its form changes. There it behaves like a power 3/2 of the distance,
// which the substitution z = middle - half cos(t) turns into a smooth function of t, so that
// Gauss's rule converges fast (spheres: rounding; polyhedra: see below). Over a sphere's whole
// height the integral is known, in complete elliptic integrals.
#pragma once

#include "engine/shape/pose.hpp"

namespace grainsweep {

/// Area shared by two discs whose centres are `distance` apart, d^2.
double shared_area(double radius, double other_radius, double distance);

/// Volume of the part of a sphere whose centre lies at `distance` from the axis of a cylinder of
/// radius `tube`, in it, and between the heights `low` and `high` above the sphere's centre, d^3.
/// Exact to 1e-13 of the sphere's volume, and to rounding where both heights lie beyond the sphere.
double sphere_tube_volume(double radius, double distance, double tube, double low, double high);

/// Volume of the part of a grain in an upright cylinder of radius `tube` about the vertical line
/// through x = y = axis of the box, and between the heights `low` and `high` of the box, d^3. To
/// 1e-7 of the grain's volume.
double polyhedron_tube_volume(const ConvexShape& shape, const Pose& pose, double axis, double tube,
                              double low, double high);

}  // namespace grainsweep
