// A small bed as the engine settles it.
#pragma once

#include "engine/dynamics/presets.hpp"
#include "engine/packing.hpp"
#include "kernels/kernels.hpp"
#include "runner/export/exported_bed.hpp"

namespace grainsweep {

inline ExportedBed packed_bed(const ShapeSpec& shape, const Box& box, std::int64_t grains,
                              const char* accuracy = "fast") {
  PackingSpec spec;
  spec.shape = shape;
  spec.box = box;
  spec.fill = GrainCount{grains};
  spec.accuracy = *preset(accuracy);
  spec.measure.exclude_floor = 1.0;
  spec.measure.exclude_surface = 1.0;
  Packing packing =
      make_packing(spec, kernels_for(Isa::sse2), [](const Progress&) { return true; });
  ExportedBed exported;
  exported.bed.box = spec.box;
  exported.bed.grains = packing.grains;
  exported.bed.turned = packing.turned;
  exported.bed.forces = packing.forces;
  exported.bed.wall_forces = packing.wall_forces;
  exported.bed.lines = packing.lines;
  exported.bed.wall_lines = packing.wall_lines;
  exported.gap_tolerance = spec.measure.gap_tolerances.front();
  return exported;
}

}  // namespace grainsweep
