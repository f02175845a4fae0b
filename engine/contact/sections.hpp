// Horizontal sections of a large bed, whose rows several cores may sweep.
//
// A row belongs to the lower of its two grains' sections. Sections are made of
// layers of candidates, and no pair reaches beyond the next layer: rows of sections 0, 2, 4 share
// no grain, nor do those of 1, 3, 5. Small beds are one section.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/contact/candidates.hpp"
#include "engine/processor.hpp"

namespace grainsweep {

/// Memory of a division, kept from one to the next.
struct Sections {
  std::size_t count = 1;
  std::vector<std::int32_t> of_layer;    ///< section of each layer of the candidates
  std::vector<std::size_t> layer_size;   ///< grains of each layer
  std::vector<GrainPair> pairs;          ///< candidates by section, in their order
  std::vector<std::size_t> begin;        ///< first pair of each section; one more at the end
  std::vector<std::int32_t> grains;      ///< all grains by section, ascending in each
  std::vector<std::size_t> first_grain;  ///< of each section in `grains`; one more at the end
  std::vector<std::size_t> place;        ///< next place in each section of each part of a sort
};

/// Section of a grain of the bed that `candidates` was made of.
inline std::size_t section_of(const Candidates& candidates, const Sections& sections,
                              std::int32_t grain) {
  const std::int32_t layer = candidates.layer[static_cast<std::size_t>(grain)];
  return static_cast<std::size_t>(sections.of_layer[static_cast<std::size_t>(layer)]);
}

/// Divides the bed of `candidates` by its layers and sorts its pairs and grains by section.
void divide(const Candidates& candidates, const PartLoop& loop, Sections& sections);

/// Calls work(section) for all sections: for 0, 2, 4 .. in any order, then for 1, 3, 5 ..
template <class Work>
void visit_sections(std::size_t count, const PartLoop& loop, const Work& work) {
  run_parts(loop, (count + 1) / 2, [&](std::size_t k) { work(2 * k); });
  if (count > 1) {
    run_parts(loop, count / 2, [&](std::size_t k) { work(2 * k + 1); });
  }
}

}  // namespace grainsweep
