#include "engine/narrow/constraints.hpp"

namespace grainsweep {

namespace {

// Points closer than this, d, are one; points this close to a line are on it.
constexpr double one_place = 1e-6;

/// The touching point for which `measure` is largest, if that is beyond `one_place`.
template <class Measure>
const ContactPoint* farthest_touching(const ContactPoint* points, std::size_t count,
                                      double tolerance, Measure measure) {
  const ContactPoint* best = nullptr;
  for (const ContactPoint* point = points; point != points + count; ++point) {
    if (point->gap < tolerance && measure(*point) > one_place &&
        (best == nullptr || measure(*point) > measure(*best))) {
      best = point;
    }
  }
  return best;
}

}  // namespace

ConstraintPoints constraint_points(const ContactPoint* points, std::size_t count,
                                   double tolerance) {
  const ContactPoint* first =
      farthest_touching(points, count, tolerance, [](const ContactPoint&) { return 1.0; });
  if (first == nullptr) return {};
  const ContactPoint* second = farthest_touching(
      points, count, tolerance,
      [&](const ContactPoint& p) { return (p.position - first->position).norm(); });
  if (second == nullptr) return {{first}, 1};
  const Vector along = (second->position - first->position).normalized();
  const ContactPoint* third = farthest_touching(
      points, count, tolerance,
      [&](const ContactPoint& p) { return (p.position - first->position).cross(along).norm(); });
  return {{first, second, third}, third == nullptr ? 2 : 3};
}

}  // namespace grainsweep
