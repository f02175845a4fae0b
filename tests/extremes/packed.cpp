#include "tests/extremes/packed.hpp"

#include <algorithm>
#include <cmath>

#include "engine/units.hpp"

namespace grainsweep::extremes {

namespace {

/// All the numbers that a packing which says nothing of failure must give.
bool is_finite(const PackingResult& result) {
  bool finite = std::isfinite(result.solid_fraction) && std::isfinite(result.surface_height) &&
                std::isfinite(result.rest.step_residual) &&
                std::isfinite(result.rest.kinetic_energy) &&
                std::isfinite(result.rest.overlap_mean) && std::isfinite(result.mean_diameter);
  for (const Coordination& z : result.coordination) finite = finite && std::isfinite(z.with_walls);
  return finite;
}

bool is_finite(const std::vector<SettledGrain>& grains) {
  bool finite = true;
  for (const SettledGrain& g : grains) {
    finite = finite && std::isfinite(g.x + g.y + g.z + g.radius + g.force);
  }
  return finite;
}

SphereBed bed_of(const PackingSpec& spec, const std::vector<SettledGrain>& grains) {
  std::vector<PlacedSphere> spheres;
  for (const SettledGrain& g : grains) spheres.push_back({g.x, g.y, g.z, g.radius});
  return make_bed({spec.box.length, spec.box.width, spec.box.x, spec.box.y}, spheres);
}

/// Grains at rest touch as many others as hold them, whatever their sizes. More may touch without
/// a force: a grain pushed aside on the floor stays beside what pushed it.
Answer touching_answer(const PackingSpec& spec, const SettledBed& settled) {
  const double touching = touching_count(settled.bed, spec.measure.gap_tolerances.front());
  const auto isostatic = static_cast<double>(settled.report.rest.isostatic_contacts);
  return {"gaps below 1e-4 d missing to the isostatic number",
          std::max(0.0, 1.0 - touching / isostatic), spec.accuracy.contact_tolerance,
          "promised by the accuracy"};
}

std::vector<Answer> answers(const PackingSpec& spec, const Packing& packing) {
  SettledBed settled{bed_of(spec, packing.grains), spec.accuracy, {}, {}};
  settled.report.rest = packing.result.rest;
  collect_forces(packing.forces, packing.wall_forces, settled);
  std::vector<Answer> all = answers_of_any_bed(settled);
  if (spec.sizes.small_share > 0.0) all.push_back(touching_answer(spec, settled));
  return all;
}

}  // namespace

Spheres spheres_of(const SphereBed& bed) {
  Spheres spheres;
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    const Record<double>& p = bed.position[i];
    spheres.push_back({p.x, p.y, p.z, p.w});
  }
  return spheres;
}

PackingSpec small_spec(std::int64_t grains, const Accuracy& accuracy) {
  PackingSpec spec;
  spec.box = {4, 4, Boundary::periodic, Boundary::walls};
  spec.fill = GrainCount{grains};
  spec.accuracy = accuracy;
  spec.measure.exclude_floor = spec.measure.exclude_surface = 0.0;
  spec.random_key = 1;
  return spec;
}

Finding pack_unchecked(const PackingSpec& spec) {
  const Packing packing =
      make_packing(spec, kernels_for(best_isa()), [](const Progress&) { return true; });
  const PackingResult& result = packing.result;
  Finding finding;
  finding.finite = is_finite(packing.grains);
  if (result.status == PackingStatus::failed) {
    finding.refusal = result.reason;
    return finding;
  }
  finding.finite = finding.finite && is_finite(result);
  finding.unrest = result.reason;
  if (result.status == PackingStatus::settled) finding.answers = answers(spec, packing);
  return finding;
}

Finding pack(const PackingSpec& spec) {
  const std::vector<SpecError> errors = check(spec);
  if (errors.empty()) return pack_unchecked(spec);
  Finding finding;
  finding.refusal = errors.front().path + " " + errors.front().message;
  return finding;
}

}  // namespace grainsweep::extremes
