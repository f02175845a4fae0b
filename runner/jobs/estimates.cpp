#include "runner/jobs/estimates.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <variant>

#include "runner/store/journal.hpp"
#include "runner/store/states.hpp"

namespace grainsweep {
namespace {

double bytes_of(const StoredBed& bed) { return static_cast<double>(bed_bytes(bed).size()); }

/// Of a grain at rest and its share of the contacts. Three forces hold a sphere, six numbers a
/// polyhedron; contacts along lines and over areas count as two and three of these.
double bytes_of_grain(bool is_sphere) {
  const double contacts = is_sphere ? 3.0 : 3.5;
  StoredBed none;
  if (!is_sphere) none.turned.emplace();
  StoredBed grain = none, contact = none;
  grain.grains.resize(1);
  contact.forces.resize(1);
  if (!is_sphere) {
    grain.turned->orientations.resize(1);
    grain.axes.resize(1);
    contact.lines.resize(1);
  }
  return bytes_of(grain) + contacts * bytes_of(contact) - (1.0 + contacts) * bytes_of(none);
}

/// The lengths that profiles of such a bed go over, d; 0 where it has none.
struct ProfileLengths {
  double x = 0.0, y = 0.0, from_walls = 0.0, z = 0.0;
};

ProfileLengths profile_lengths(const PackingSpec& spec) {
  const Box& box = spec.box;
  ProfileLengths lengths;
  lengths.z = probable_height(spec);
  if (box.is_tube) {
    lengths.from_walls = box.width / 2.0;
    return lengths;
  }
  const bool has_walls_x = box.x == Boundary::walls, has_walls_y = box.y == Boundary::walls;
  if (has_walls_x) lengths.x = box.length;
  if (has_walls_y) lengths.y = box.width;
  if (has_walls_x && has_walls_y) lengths.from_walls = std::min(box.length, box.width) / 2.0;
  return lengths;
}

/// Curves with as many bins as those of such a packing, which hold nothing.
Curves empty_curves(const PackingSpec& spec) {
  constexpr std::size_t order_bins = 80;  // of either curve of engine/measure/order.hpp
  const auto bins_in = [&](double length) {
    const double bins = std::ceil(length / spec.measure.bin_width);
    return std::isfinite(bins) ? static_cast<std::size_t>(std::max(0.0, bins)) : 0;
  };
  const ProfileLengths lengths = profile_lengths(spec);
  const auto* const mixture = std::get_if<Mixture>(&spec.shape);
  const std::size_t components = mixture != nullptr ? mixture->components.size() : 0;
  ComponentBin bin;
  bin.neighbours.resize(components);
  Curves curves;
  curves.components.resize(components);
  const auto add = [&](double length, Profile Curves::*profile,
                       ComponentProfile ComponentMeasure::*of_component) {
    (curves.*profile).bins.resize(bins_in(length));
    for (ComponentMeasure& component : curves.components) {
      (component.*of_component).bins.assign(bins_in(length), bin);
    }
  };
  add(lengths.x, &Curves::profile_x, &ComponentMeasure::profile_x);
  add(lengths.y, &Curves::profile_y, &ComponentMeasure::profile_y);
  add(lengths.from_walls, &Curves::profile_from_walls, &ComponentMeasure::profile_from_walls);
  add(lengths.z, &Curves::profile_z, &ComponentMeasure::profile_z);
  curves.pair_correlation.values.resize(order_bins);
  curves.force_density.values.resize(order_bins);
  return curves;
}

}  // namespace

DiskNeeds disk_needs(const PackingSpec& spec) {
  StoredBed bed;
  bed.curves = empty_curves(spec);
  const auto grains = static_cast<double>(grain_count(spec));
  const bool is_sphere = std::holds_alternative<SphereShape>(spec.shape);
  return {grains * bytes_of_grain(is_sphere),
          bytes_of(bed) + static_cast<double>(journal_line(Outcome()).size())};
}

double total_cpu_seconds(const std::vector<Cost>& costs) {
  return std::accumulate(costs.begin(), costs.end(), 0.0,
                         [](double sum, const Cost& cost) { return sum + cost.cpu_seconds; });
}

double bytes_of_largest(const std::vector<Cost>& costs, int live) {
  std::vector<double> bytes;
  bytes.reserve(costs.size());
  for (const Cost& cost : costs) bytes.push_back(cost.bytes);
  std::sort(bytes.begin(), bytes.end(), std::greater<>());
  bytes.resize(std::min(bytes.size(), static_cast<std::size_t>(live)));
  return std::accumulate(bytes.begin(), bytes.end(), 0.0);
}

void LearnedEstimates::add(double estimated, double measured) {
  for (Sums* sums : {&of_all_, &of_estimate_[estimated]}) {
    sums->measured += measured;
    sums->estimated += estimated;
  }
}

double LearnedEstimates::of(double estimated) const {
  const auto same = of_estimate_.find(estimated);
  const Sums& teacher = same == of_estimate_.end() ? of_all_ : same->second;
  return estimated * teacher.ratio();
}

std::vector<double> learned(const std::vector<Known>& packings) {
  LearnedEstimates estimates;
  for (const Known& packing : packings) {
    if (packing.measured) estimates.add(packing.estimated, *packing.measured);
  }
  std::vector<double> better;
  better.reserve(packings.size());
  for (const Known& packing : packings) better.push_back(estimates.of(packing.estimated));
  return better;
}

}  // namespace grainsweep
