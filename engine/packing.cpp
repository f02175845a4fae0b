#include "engine/packing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/dynamics/settle.hpp"
#include "engine/measure/coordination.hpp"
#include "engine/measure/order.hpp"
#include "engine/measure/profile.hpp"
#include "engine/measure/solid_fraction.hpp"
#include "engine/measure/touching.hpp"
#include "engine/scene/sizes.hpp"
#include "engine/scene/start.hpp"
#include "engine/units.hpp"

namespace grainsweep {

namespace {

Packing failed(std::string reason) {
  Packing packing;
  packing.result.reason = std::move(reason);
  return packing;
}

PackingResult result_of(const SphereBed& bed, const SettleReport& settled) {
  PackingResult result;
  result.status = settled.cancelled         ? PackingStatus::cancelled
                  : settled.why_not.empty() ? PackingStatus::settled
                                            : PackingStatus::not_settled;
  result.reason = settled.cancelled ? "stopped on request" : settled.why_not;
  result.grains = static_cast<std::int64_t>(bed.grains());
  result.rest = settled.rest;
  result.balance = settled.balance;
  result.steps = settled.steps;
  result.iterations = settled.iterations;
  result.state_hash = state_hash(bed);
  return result;
}

double widest(const std::vector<double>& tolerances) {
  return *std::max_element(tolerances.begin(), tolerances.end());
}

/// Measures what `spec` asks for; a bed too low to hold a slab fails with the reason.
void measure(const PackingSpec& packing, const Touching& touching,
             const std::vector<PairForce>& pair_forces, const Kernels& kernels, SphereBed& bed,
             PackingResult& result) {
  const MeasureSpec& spec = packing.measure;
  result.surface_height = surface_height(bed);
  const Slab slab{spec.exclude_floor, result.surface_height - spec.exclude_surface};
  result.slab_bottom = slab.bottom;
  result.slab_top = slab.top;
  if (!(slab.height() >= 1.0)) {
    result.status = PackingStatus::failed;
    result.reason =
        "the bed is too low to be measured: less than 1 d is left between the zones "
        "above the floor and below the surface; fill in more grains or make "
        "measure.exclude_floor and measure.exclude_surface smaller";
    return;
  }
  result.solid_fraction = solid_fraction(bed, slab);
  for (const double tolerance : spec.gap_tolerances) {
    result.coordination.push_back(coordination(bed, touching, slab, tolerance));
  }
  const double small_below = small_class_limit(packing.sizes), gap = spec.gap_tolerances.front();
  const ProfileSettings bins{spec.bin_width, small_below, gap};
  result.profile_y = profile_along_y(bed, touching, slab, bins);
  result.profile_z = profile_along_z(bed, touching, bins);
  result.order = measure_order(bed, touching, pair_forces, slab, {small_below, gap}, kernels);
}

void measure_sizes(const SphereBed& bed, PackingResult& result) {
  double volume = 0.0, by_volume = 0.0, diameters = 0.0;
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    const double diameter = 2.0 * bed.position[i].w, mass = sphere_mass(bed.position[i].w);
    diameters += diameter;
    volume += mass;
    by_volume += mass * diameter;
  }
  result.mean_diameter = diameters / static_cast<double>(bed.grains());
  result.mean_diameter_by_volume = by_volume / volume;
}

std::vector<SettledGrain> grains_of(const SphereBed& bed, const Touching& touching,
                                    double gap_tolerance, const std::vector<double>& force) {
  const auto neighbours = neighbour_counts(bed.grains(), touching, gap_tolerance);
  std::vector<SettledGrain> grains(bed.grains());
  for (std::size_t i = 0; i < grains.size(); ++i) {
    const Record<double>& p = bed.position[i];
    grains[i] = {p.x, p.y, p.z, p.w, force[i], neighbours[i]};
  }
  return grains;
}

}  // namespace

const char* name_of(PackingStatus status) {
  switch (status) {
    case PackingStatus::settled:
      return "settled";
    case PackingStatus::not_settled:
      return "not_settled";
    case PackingStatus::cancelled:
      return "cancelled";
    case PackingStatus::failed:
      return "failed";
  }
  return "unknown";
}

Packing make_packing(const PackingSpec& spec, const Processor& processor,
                     const KeepGoing& keep_going, std::string_view saved) {
  std::optional<SphereBed> bed = start(spec);
  if (!bed) {
    return failed(
        "a grain found no room in the box: it is larger than the gap between the walls, "
        "or the box is too crowded");
  }
  if (!is_finite(*bed)) {
    return failed(
        "a grain's place, radius or inverse mass is not a finite number at the start: correct "
        "fill.file, whose radii are perhaps not in d");
  }
  const SettleReport settled = settle(spec.accuracy, processor, *bed, keep_going, saved);
  if (!is_finite(*bed)) {
    return failed("the bed blew up in step " + std::to_string(settled.steps) +
                  ": a grain's place is no longer a finite number; take accuracy.precision f64, or "
                  "leave out grains far smaller than d");
  }
  Packing packing{result_of(*bed, settled), {}};
  if (settled.cancelled) {
    return packing;
  }
  measure_sizes(*bed, packing.result);
  const Touching touching =
      find_touching(*bed, widest(spec.measure.gap_tolerances), processor.kernels);
  measure(spec, touching, settled.pair_forces, processor.kernels, *bed, packing.result);
  packing.grains = grains_of(*bed, touching, spec.measure.gap_tolerances.front(), settled.force);
  return packing;
}

// Measured on one core of a 2.4 GHz server: a sweep over a row costs 2.7 ns, and a bed has about
// four rows per grain; iterations as the stages of engine/dynamics/settle.hpp usually need them.
Cost estimate_cost(const PackingSpec& spec) {
  constexpr double seconds_per_row = 2.7e-9, rows_per_grain = 4.0, bytes_per_grain = 900.0;
  const auto grains = static_cast<double>(grain_count(spec));
  const Accuracy& a = spec.accuracy;
  const bool is_dynamic = a.protocol == Protocol::dynamic;
  const double fall = (is_dynamic ? 2000.0 : 130.0) * a.fall_iterations;
  const double creep = (is_dynamic ? 15.0 : a.creep_steps * 2.0 / 3.0 + 25.0) * a.rest_iterations;
  const double number_size = a.precision == Precision::f32 ? 1.0 : 2.0;
  return {grains * rows_per_grain * number_size * (fall + creep) * seconds_per_row,
          1e6 + grains * bytes_per_grain * number_size};
}

}  // namespace grainsweep
