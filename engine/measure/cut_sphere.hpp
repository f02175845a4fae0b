// Volumes that two planes at right angles cut from a sphere, in closed form.
//
// With r the radius, a and b the planes' signed distances from the centre, P(t) = r^2 t - t^3 / 3
// and s = sqrt(r^2 - a^2 - b^2), the part of the ball with y > a and z > b has the volume
//   2/3 r^3 atan2(r s, a b) + 2/3 a b s - P(a) atan2(s, b) - P(b) atan2(s, a)
// wherever the planes' common line meets the ball (a^2 + b^2 < r^2); it follows by integrating the
// circular segments y > a of the discs z = const. Elsewhere the part is a cap, a ball without caps,
// or nothing.
#pragma once

namespace grainsweep {

/// Volume of the part of a sphere about the origin with y > a and z > b, d^3.
double sphere_corner_volume(double radius, double a, double b);

/// Volume of the part of a sphere about the origin with y < top_y and low_z < z < high_z, d^3.
double sphere_beam_volume(double radius, double top_y, double low_z, double high_z);

}  // namespace grainsweep
