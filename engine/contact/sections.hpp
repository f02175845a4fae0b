// Sections of a large bed, whose rows several cores may sweep.
//
// A section is made of slabs of the search grid across an axis, and no pair reaches beyond the next
// slab. A row belongs to the first of its two grains' sections: rows of sections 0, 2, 4 share no
// grain, nor do those of 1, 3, 5. Along a periodic axis sections are a ring of even number, and the
// first one follows the last. Small beds are one section.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/contact/candidates.hpp"
#include "engine/processor.hpp"

namespace grainsweep {

/// Memory of a division, kept from one to the next.
struct Sections {
  std::size_t count = 1;
  bool is_ring = false;
  std::vector<std::int32_t> slab;        ///< slab of each grain
  std::vector<std::int32_t> of_slab;     ///< section of each slab
  std::vector<std::size_t> slab_size;    ///< grains of each slab
  std::vector<GrainPair> pairs;          ///< candidates by section, in their order
  std::vector<std::size_t> begin;        ///< first pair of each section; one more at the end
  std::vector<std::int32_t> grains;      ///< all grains by section, ascending in each
  std::vector<std::size_t> first_grain;  ///< of each section in `grains`; one more at the end
  std::vector<std::size_t> place;        ///< next place in each section of each part of a sort

  std::size_t section_of(std::int32_t grain) const {
    if (count == 1) return 0;
    const std::int32_t own = slab[static_cast<std::size_t>(grain)];
    return static_cast<std::size_t>(of_slab[static_cast<std::size_t>(own)]);
  }
  /// Section of the rows of a pair.
  std::size_t section_of(GrainPair pair) const;
};

/// Divides the bed of `candidates` and sorts its pairs and grains by section.
void divide(const SphereBed& bed, const Candidates& candidates, const PartLoop& loop,
            Sections& sections);

/// Calls work(section) for all sections: for 0, 2, 4 .. in any order, then for 1, 3, 5 ..
template <class Work>
void visit_sections(std::size_t count, const PartLoop& loop, const Work& work) {
  run_parts(loop, (count + 1) / 2, [&](std::size_t k) { work(2 * k); });
  if (count > 1) {
    run_parts(loop, count / 2, [&](std::size_t k) { work(2 * k + 1); });
  }
}

}  // namespace grainsweep
