#include "runner/sweep/low_beds.hpp"

#include <cstddef>
#include <variant>
#include <vector>

#include "engine/text.hpp"

namespace grainsweep {
namespace {

/// The beds of a block that are too low.
struct LowBeds {
  std::size_t sets = 0, low = 0;  ///< parameter sets, and how many of them are too low
  const PackingSpec* lowest = nullptr;
  double height = 0.0;  ///< of the lowest, d
};

/// A few of a file's grains may be packed only to be exported.
void count(const PackingSpec& spec, LowBeds& beds) {
  ++beds.sets;
  if (std::holds_alternative<PlacedGrains>(spec.fill)) return;
  const double height = probable_height(spec);
  if (height >= least_height(spec.measure)) return;
  ++beds.low;
  if (beds.lowest == nullptr || height < beds.height) beds.lowest = &spec, beds.height = height;
}

std::string note_on(const LowBeds& beds) {
  const PackingSpec& spec = *beds.lowest;
  const char* const across = spec.box.is_tube ? "tube.diameter " : "box.width ";
  return joined(beds.low, " of ", beds.sets,
                " parameter sets will probably come out too low to be measured: with ", across,
                bound_text(spec.box.is_tube ? spec.box.length : spec.box.width), " about ",
                number_text(beds.height, 2), " d high, where measure.exclude_floor, ",
                "measure.exclude_surface and a slab of ", bound_text(least_slab_height),
                " d between them take ", number_text(least_height(spec.measure)),
                " d; give that one ", enough_fill(spec), " or more, or leave less out");
}

}  // namespace

Diagnostics notes_on_low_beds(const Sweep& sweep) {
  std::vector<LowBeds> blocks(sweep.block_pointers.size());
  for (const Job& job : sweep.jobs) {
    if (job.replicate == 1) count(job.spec, blocks[job.block]);
  }
  Diagnostics notes;
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    if (blocks[k].low == 0) continue;
    notes.push_back({sweep.block_pointers[k], note_on(blocks[k]), Anchor::value, "", true});
  }
  return notes;
}

}  // namespace grainsweep
