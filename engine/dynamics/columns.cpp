#include "engine/dynamics/columns.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace grainsweep {

namespace {

constexpr double largest_factor = 2.0;

/// Mass of the grains above the planes z = 0, 1, 2 .. d, m.
std::vector<double> masses_above(const Grains& bed, std::size_t planes) {
  std::vector<double> above(planes + 1, 0.0);
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    const auto below = static_cast<std::size_t>(std::max(0.0, bed.position[i].z));
    above[below] += 1.0 / bed.motion[i].w;
  }
  for (std::size_t k = planes; k-- > 0;) above[k] += above[k + 1];
  return above;
}

/// Calls visit(impulse, lift, low, high) for each row that pushes: the vertical part of its
/// impulse, and the heights between which it passes that on. The push of the floor comes from below
/// z = 0.
template <class Real, class Visit>
void visit_lifts(const SphereBed& bed, SphereContacts<Real>& contacts, const Visit& visit) {
  const auto height = [&](std::int32_t grain) {
    return bed.position[static_cast<std::size_t>(grain)].z;
  };
  for (std::size_t at = 0; at < contacts.impulse.size(); ++at) {
    Real& impulse = contacts.impulse[at];
    if (impulse == Real(0)) continue;
    const std::size_t block = at / block_width, lane = at % block_width;
    const RowBlock<Real>& row = contacts.rows[block];
    const double up = std::abs(static_cast<double>(row.normal_z[lane]));
    const double one = height(row.a(lane));
    const bool is_pair = block < contacts.pair_blocks;
    const double other = is_pair ? height(row.b(lane)) : up > 0.0 ? -up : one;
    visit(impulse, static_cast<double>(impulse) * up, std::min(one, other), std::max(one, other));
  }
}

/// The factors by which impulses would have to be multiplied at each plane.
template <class Real>
std::vector<double> factors_of(double dt, const SphereBed& bed, SphereContacts<Real>& contacts) {
  const std::size_t planes = static_cast<std::size_t>(top_of(bed)) + 2;
  const std::vector<double> above = masses_above(bed, planes);
  std::vector<double> lift(planes, 0.0);
  visit_lifts(bed, contacts, [&](Real&, double passed, double low, double high) {
    for (double z = std::max(0.0, std::ceil(low)); z < high; z += 1.0) {
      lift[static_cast<std::size_t>(z)] += passed;
    }
  });
  std::vector<double> factor(planes, 1.0);
  for (std::size_t k = 0; k < planes; ++k) {
    if (!(lift[k] > 0.0)) continue;
    const double due = above[k] * dt * dt;
    factor[k] = std::clamp(due / lift[k], 1.0 / largest_factor, largest_factor);
  }
  return factor;
}

}  // namespace

double top_of(const Grains& bed) {
  double top = 0.0;
  for (std::size_t i = 0; i < bed.grains(); ++i) top = std::max(top, bed.position[i].z);
  return top;
}

template <class Real>
void carry_weight(double dt, const SphereBed& bed, SphereContacts<Real>& contacts) {
  const std::vector<double> factor = factors_of(dt, bed, contacts);
  visit_lifts(bed, contacts, [&](Real& impulse, double, double low, double high) {
    const double middle = std::max(0.0, 0.5 * (low + high));
    const auto below = static_cast<std::size_t>(middle);
    const double share = middle - static_cast<double>(below);
    const double above = factor[std::min(below + 1, factor.size() - 1)];
    impulse = static_cast<Real>(static_cast<double>(impulse) *
                                ((1.0 - share) * factor[below] + share * above));
  });
}

template void carry_weight(double, const SphereBed&, SphereContacts<float>&);
template void carry_weight(double, const SphereBed&, SphereContacts<double>&);

}  // namespace grainsweep
