#include "tests/extremes/zigzag.hpp"

namespace grainsweep::extremes {

SphereBed zigzag_bed(const std::vector<double>& masses, double gap) {
  std::vector<PlacedSphere> spheres;
  for (std::size_t k = 0; k < masses.size(); ++k) {
    const double side = k % 2 == 0 ? 0.5 : zigzag_side - 0.5, height = static_cast<double>(k);
    spheres.push_back({side, side, 0.5 + gap + height * (zigzag_rise + gap), 0.5});
  }
  SphereBed bed = make_bed({zigzag_side, zigzag_side, Boundary::walls, Boundary::walls}, spheres);
  for (std::size_t k = 0; k < masses.size(); ++k) bed.motion[k].w = 1.0 / masses[k];
  return bed;
}

std::vector<double> carried_weights(const std::vector<double>& masses) {
  std::vector<double> carried(masses);
  for (std::size_t k = masses.size() - 1; k-- > 0;) carried[k] += carried[k + 1];
  return carried;
}

}  // namespace grainsweep::extremes
