#include "bench/peers/bed_measures.hpp"

#include <algorithm>
#include <limits>

#include "engine/dynamics/rest.hpp"
#include "engine/measure/coordination.hpp"
#include "engine/measure/solid_fraction.hpp"
#include "engine/measure/touching.hpp"
#include "engine/rows/sphere_contacts.hpp"
#include "runner/tables/csv.hpp"

namespace grainsweep::bench {

namespace {

void add_overlap(double gap, BedMeasures& measures) {
  ++measures.near;
  if (gap > 0.0) return;
  ++measures.overlapping;
  measures.overlap_mean -= gap;  // a sum until all are added
  measures.overlap_max = std::max(measures.overlap_max, -gap);
}

void add_overlaps(const Touching& touching, BedMeasures& measures) {
  for (const TouchingPair& pair : touching.pairs) add_overlap(pair.gap, measures);
  for (const TouchingWall& wall : touching.walls) add_overlap(wall.gap, measures);
  measures.overlap_mean /= static_cast<double>(std::max<std::int64_t>(measures.overlapping, 1));
}

/// The engine counts zero modes of contacts that push: here every near one is taken to.
std::int64_t isostatic_count(SphereBed& bed, const Kernels& kernels) {
  Candidates candidates;
  SphereContacts<double> contacts;
  wrap(bed);
  find_candidates({bed, bed.position}, near_gap, kernels, candidates);
  lay_out(bed, candidates, contacts);
  update_gaps(bed, kernels, 1.0, contacts);
  for (std::size_t row = 0; row < contacts.impulse.size(); ++row) {
    const bool near = contacts.rows[row / block_width].gap[row % block_width] < near_gap;
    contacts.impulse[row] = near ? 1.0 : 0.0;
  }
  return 3 * static_cast<std::int64_t>(bed.grains()) -
         zero_modes(bed, force_contacts(bed, 1.0, contacts));
}

}  // namespace

BedMeasures measures_of(SphereBed& bed, const MeasureSpec& measure, const Kernels& kernels) {
  BedMeasures measures;
  measures.grains = static_cast<std::int64_t>(bed.grains());
  const Touching touching = find_touching(bed, near_gap, kernels);
  add_overlaps(touching, measures);
  measures.isostatic = isostatic_count(bed, kernels);
  const Slab slab{measure.exclude_floor, surface_height(bed) - measure.exclude_surface};
  measures.solid_fraction =
      slab.height() > 0.0 ? solid_fraction(bed, slab) : std::numeric_limits<double>::quiet_NaN();
  measures.coordination = coordination(bed, touching, slab, near_gap);
  return measures;
}

std::string csv_header() {
  return "grains,overlap_mean,overlap_max,contacts_overlapping,contacts_near,isostatic_contacts,"
         "solid_fraction,coordination,coordination_with_walls\n";
}

std::string csv_row(const BedMeasures& m) {
  return csv_line({cell(m.grains), cell(m.overlap_mean), cell(m.overlap_max), cell(m.overlapping),
                   cell(m.near), cell(m.isostatic), cell(m.solid_fraction),
                   cell(m.coordination.between_grains), cell(m.coordination.with_walls)});
}

}  // namespace grainsweep::bench
