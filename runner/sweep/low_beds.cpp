#include "runner/sweep/low_beds.hpp"

#include <cmath>
#include <variant>

#include "engine/text.hpp"

namespace grainsweep {
namespace {

/// What a bed needs for the zones that are left out and a slab between them, d.
double least_height(const MeasureSpec& measure) {
  return measure.exclude_floor + measure.exclude_surface + least_slab_height;
}

/// Of a file's grains a few may be packed to be exported alone.
bool is_probably_too_low(const PackingSpec& spec) {
  return !std::holds_alternative<PlacedGrains>(spec.fill) &&
         probable_height(spec) < least_height(spec.measure);
}

/// What to fill in, with a tenth to spare.
std::string remedy_of(const PackingSpec& spec) {
  const double times = 1.1 * least_height(spec.measure) / probable_height(spec);
  const auto* grains = std::get_if<GrainCount>(&spec.fill);
  const double asked = grains != nullptr ? static_cast<double>(grains->count)
                                         : std::get<SolidHeight>(spec.fill).height;
  return grains != nullptr ? joined("fill.grains ", static_cast<std::int64_t>(asked * times))
                           : "fill.solid_height " + number_text(asked * times);
}

std::string note_on(const Job& lowest, std::size_t low, std::size_t sets) {
  const PackingSpec& spec = lowest.spec;
  const char* const across = spec.box.is_tube ? "tube.diameter " : "box.width ";
  return joined(low, " of ", sets,
                " parameter sets will probably come out too low to be measured: with ", across,
                bound_text(spec.box.is_tube ? spec.box.length : spec.box.width), " about ",
                number_text(probable_height(spec), 2), " d high, where measure.exclude_floor, ",
                "measure.exclude_surface and a slab of ", bound_text(least_slab_height),
                " d between them take ", number_text(least_height(spec.measure)),
                " d; give that one ", remedy_of(spec), " or more, or leave less out");
}

}  // namespace

Diagnostics notes_on_low_beds(const SweepDefinition& definition, const std::vector<Job>& jobs) {
  Diagnostics notes;
  for (std::size_t block = 0; block < definition.blocks.size(); ++block) {
    const Job* lowest = nullptr;
    std::size_t low = 0, sets = 0;
    for (const Job& job : jobs) {
      if (job.block != block || job.replicate != 1) continue;
      ++sets;
      if (!is_probably_too_low(job.spec)) continue;
      ++low;
      const bool is_lowest =
          lowest == nullptr || probable_height(job.spec) < probable_height(lowest->spec);
      if (is_lowest) lowest = &job;
    }
    if (lowest == nullptr) continue;
    notes.push_back(
        {definition.blocks[block].pointer, note_on(*lowest, low, sets), Anchor::value, "", true});
  }
  return notes;
}

}  // namespace grainsweep
