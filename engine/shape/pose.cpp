#include "engine/shape/pose.hpp"

namespace grainsweep {

PairPose seen_from_a(const Pose& a, const Pose& b, const Vector& difference) {
  const Quaternion back = a.orientation.conjugate();
  return {back.toRotationMatrix() * difference, (back * b.orientation).toRotationMatrix(), a.scale,
          b.scale};
}

}  // namespace grainsweep
