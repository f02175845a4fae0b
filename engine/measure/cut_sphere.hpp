// Volumes that two or three planes at right angles cut from a sphere, in closed form.
//
// With r the radius, a and b the planes' signed distances from the centre, P(t) = r^2 t - t^3 / 3
// and s = sqrt(r^2 - a^2 - b^2), the part of the ball with y > a and z > b has the volume
//   2/3 r^3 atan2(r s, a b) + 2/3 a b s - P(a) atan2(s, b) - P(b) atan2(s, a)
// wherever the planes' common line meets the ball (a^2 + b^2 < r^2); it follows by integrating the
// circular segments y > a of the discs z = const. Elsewhere the part is a cap, a ball without caps,
// or nothing.
//
// A third plane x > c: where the planes' common point lies in the ball and no distance is negative
// (else the part is what the mirrored plane leaves), the divergence theorem gives
//   V = (r S - a A_a - b A_b - c A_c) / 3
// with the areas A of its plane faces, corners of discs, and S of the patch of the sphere, which is
// a triangle between three circles: by Gauss and Bonnet, with phi_a the angle of the arc on y = a,
//   S = r^2 (2 pi - sum over pairs acos(-a b / sqrt((r^2 - a^2) (r^2 - b^2))) - sum a phi_a / r).
#pragma once

#include "engine/measure/slab.hpp"

namespace grainsweep {

/// Volume of the part of a sphere about the origin with y > a and z > b, d^3.
double sphere_corner_volume(double radius, double a, double b);

/// Volume of the part of a sphere about the origin with y < top_y and low_z < z < high_z, d^3.
double sphere_beam_volume(double radius, double top_y, double low_z, double high_z);

/// Volume of the part of a sphere about the origin with x > a, y > b and z > c, d^3.
double sphere_octant_volume(double radius, double a, double b, double c);

/// Volume of the part of a sphere about the origin within three spans, d^3.
double sphere_box_volume(double radius, const Span& x, const Span& y, const Span& z);

}  // namespace grainsweep
