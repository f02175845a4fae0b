#include "engine/dynamics/dissection.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>
#include <utility>

namespace grainsweep {

namespace {

constexpr std::ptrdiff_t few_contacts = 32;  // not worth a plane

/// Where a plane stands along the axis across which it lies.
struct Plane {
  double Record<double>::*axis = &Record<double>::x;
  double place = 0.0;  ///< d
};

class Dissection {
 public:
  Dissection(std::span<const Record<double>> centres, const std::vector<GrainPair>& contacts)
      : centres_(centres), contacts_(contacts), order_(contacts.size()) {
    std::iota(order_.begin(), order_.end(), 0);
    dissect(order_.begin(), order_.end());
  }
  std::vector<std::int32_t> take_order() { return std::move(order_); }

 private:
  using At = std::vector<std::int32_t>::iterator;

  void dissect(At first, At last) {
    if (last - first <= few_contacts) return;
    const std::optional<Plane> plane = best_plane(first, last);
    if (!plane) return;
    const At below_end = std::stable_partition(
        first, last, [&](std::int32_t contact) { return grains_above(*plane, contact) == 0; });
    const At above_end = std::stable_partition(
        below_end, last, [&](std::int32_t contact) { return grains_above(*plane, contact) == 2; });
    dissect(first, below_end);
    dissect(below_end, above_end);
  }

  /// None if each leaves no contact on one of its sides.
  std::optional<Plane> best_plane(At first, At last) const {
    std::optional<Plane> best;
    std::ptrdiff_t fewest = last - first;
    for (const auto axis : {&Record<double>::x, &Record<double>::y, &Record<double>::z}) {
      std::vector<double> middles;
      for (At at = first; at != last; ++at) {
        const auto [p, q] = grains_of(*at);
        middles.push_back((p.*axis + q.*axis) / 2.0);
      }
      std::sort(middles.begin(), middles.end());
      for (const double share : {0.46, 0.48, 0.5, 0.52, 0.54}) {
        const Plane plane{
            axis, middles[static_cast<std::size_t>(share * static_cast<double>(middles.size()))]};
        std::array<std::ptrdiff_t, 3> count{};
        for (At at = first; at != last; ++at) ++count[grains_above(plane, *at)];
        if (count[0] == 0 || count[2] == 0 || count[1] >= fewest) continue;
        fewest = count[1];
        best = plane;
      }
    }
    return best;
  }

  /// Of the two of a contact.
  std::size_t grains_above(const Plane& plane, std::int32_t contact) const {
    const auto [p, q] = grains_of(contact);
    return (p.*plane.axis < plane.place ? 0 : 1) + (q.*plane.axis < plane.place ? 0 : 1);
  }

  std::pair<const Record<double>&, const Record<double>&> grains_of(std::int32_t contact) const {
    const GrainPair pair = contacts_[static_cast<std::size_t>(contact)];
    return {centres_[static_cast<std::size_t>(pair.a)], centres_[static_cast<std::size_t>(pair.b)]};
  }

  std::span<const Record<double>> centres_;
  const std::vector<GrainPair>& contacts_;
  std::vector<std::int32_t> order_;
};

}  // namespace

std::vector<std::int32_t> elimination_order(std::span<const Record<double>> centres,
                                            const std::vector<GrainPair>& contacts) {
  return Dissection(centres, contacts).take_order();
}

}  // namespace grainsweep
