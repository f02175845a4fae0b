// Where a grain is, and how it is turned.
#pragma once

#include <Eigen/Geometry>

#include "engine/shape/convex_shape.hpp"
#include "kernels/kernels.hpp"

namespace grainsweep {

using Quaternion = Eigen::Quaterniond;

/// The first three numbers of a record: a place or a motion.
template <class Real>
Vector vector_of(const Record<Real>& r) {
  return {static_cast<double>(r.x), static_cast<double>(r.y), static_cast<double>(r.z)};
}

struct Pose {
  Vector centre = Vector::Zero();  ///< d
  double scale = 1.0;
  Quaternion orientation = Quaternion::Identity();  ///< unit; from the shape's frame to the box's

  /// Where a point of the shape, in its frame, lies in the box, d.
  Vector place(const Vector& point) const { return centre + orientation * (scale * point); }
};

/// The pose in two records of a bed's columns: x, y, z, half the scale, and x, y, z, w of the
/// quaternion.
inline Pose pose_of(const Record<double>& centre, const Record<double>& orientation) {
  return {vector_of(centre),
          2.0 * centre.w,
          {orientation.w, orientation.x, orientation.y, orientation.z}};
}

/// Grain b as grain a sees it: in the shape frame of a, turned but not scaled. Nothing here grows
/// with the distance of the grains from the box's origin.
struct PairPose {
  Vector centre = Vector::Zero();    ///< of b, minus that of a, d
  Matrix turn = Matrix::Identity();  ///< from the shape frame of b to that of a
  double scale_a = 1.0, scale_b = 1.0;
};

/// `difference`: centre of b minus centre of a in the box's frame, for their nearest images, d.
inline PairPose seen_from_a(const Pose& a, const Pose& b, const Vector& difference) {
  const Quaternion back = a.orientation.conjugate();
  return {back.toRotationMatrix() * difference, (back * b.orientation).toRotationMatrix(), a.scale,
          b.scale};
}

}  // namespace grainsweep
