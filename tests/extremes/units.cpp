#include <cmath>

#include "engine/scene/start.hpp"
#include "runner/sweep/grains_csv.hpp"
#include "tests/extremes/accuracy_names.hpp"
#include "tests/extremes/catalogue.hpp"
#include "tests/extremes/judge.hpp"
#include "tests/extremes/packed.hpp"
#include "tests/extremes/zigzag.hpp"

namespace grainsweep::extremes {

namespace {

/// A bed in a unit of length in which d is `diameter`.
Spheres in_unit(const Spheres& spheres, double diameter) {
  Spheres scaled;
  for (const PlacedSphere& s : spheres) {
    scaled.push_back({s.x * diameter, s.y * diameter, s.z * diameter, s.radius * diameter});
  }
  return scaled;
}

/// A random bed settled as it is and by way of another unit: the states must have the same bits.
Finding settle_in_unit(double diameter, const Accuracy& accuracy) {
  const SphereBed bed = *start<Sphere>(small_spec(60, accuracy));
  const Spheres read = scaled_grains(in_unit(spheres_of(bed), diameter), diameter);
  const SettledBed plain = settle_scene(bed, accuracy);
  const SettledBed scaled = settle_scene(make_bed(bed.box, read), accuracy);
  const bool same = state_hash(plain.bed) == state_hash(scaled.bed);
  return finding_of(scaled,
                    {{"bits that differ", same ? 0.0 : 1.0, 0.0, "powers of two are exact"}});
}

/// A tower settled by way of another unit: its start differs by a rounding or two.
Finding tower_in_unit(double diameter, const Accuracy& accuracy) {
  const SphereBed bed = zigzag_bed({1, 1, 1, 1, 1}, 1e-3);
  const Spheres read = scaled_grains(in_unit(spheres_of(bed), diameter), diameter);
  const SettledBed plain = settle_scene(bed, accuracy);
  const SettledBed scaled = settle_scene(make_bed(bed.box, read), accuracy);
  double worst = 0.0;
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    const Record<double>&p = plain.bed.position[i], &q = scaled.bed.position[i];
    worst = std::max(worst, std::hypot(p.x - q.x, p.y - q.y, p.z - q.z));
  }
  return finding_of(
      scaled, {{"difference of a place, d", worst, 1e-12,
                "roundings of 1e-16 of five grains a d apart, through some hundred steps that "
                "draw nearer to one state"}});
}

}  // namespace

std::vector<Scene> units() {
  std::vector<Scene> scenes;
  const NamedAccuracy balanced = at_preset("balanced");
  NamedAccuracy solved = tight();
  solved.accuracy.residual_tolerance = 1e-12;
  solved.name = "`accurate`, f64, 1e-12 m g";
  for (const int power : {-100, -40, -10, -1, 1, 10, 40, 100}) {
    const double diameter = std::ldexp(1.0, power);
    scenes.push_back({"units", "a bed of 60", "d is 2^" + std::to_string(power), balanced.name,
                      Outcome::right, [=] { return settle_in_unit(diameter, balanced.accuracy); }});
  }
  for (const char* text : {"1e-30", "1e-10", "1e-3", "1e3", "1e10", "1e30"}) {
    const double diameter = std::stod(text);
    scenes.push_back({"units", "tower of 5", std::string("d is ") + text, solved.name,
                      Outcome::right, [=] { return tower_in_unit(diameter, solved.accuracy); }});
  }
  return scenes;
}

}  // namespace grainsweep::extremes
