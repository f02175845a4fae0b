#include "engine/contact/sections.hpp"

#include <algorithm>
#include <utility>

namespace grainsweep {

namespace {

bool is_periodic(const Box& box, int axis) {
  return (axis == 0 && box.x == Boundary::periodic) || (axis == 1 && box.y == Boundary::periodic);
}

/// The slab of each grain and the size of each slab.
void count_slabs(const SphereBed& bed, const Candidates& candidates, const PartLoop& loop,
                 Sections& sections) {
  const Cells& cells = candidates.levels.front().cells;
  sections.slab.resize(bed.grains());
  run_shares(loop, bed.grains(), bed.sections, [&](std::size_t, Share share) {
    for (std::size_t i = share.first; i < share.last; ++i) {
      sections.slab[i] = cells.place_along(bed.section_axis, candidates.built_at[i]);
    }
  });
  sections.slab_size.assign(static_cast<std::size_t>(cells.inner(bed.section_axis)), 0);
  for (const std::int32_t slab : sections.slab) {
    ++sections.slab_size[static_cast<std::size_t>(slab)];
  }
}

/// A section ends with the slab that fills it, unless that is the last one. Of a ring's odd number
/// the last two are joined.
void cut(Sections& sections) {
  const std::vector<std::size_t>& slab_size = sections.slab_size;
  sections.of_slab.assign(slab_size.size(), 0);
  sections.count = 1;
  std::size_t grains = 0;
  for (std::size_t k = 0; k < slab_size.size(); ++k) {
    sections.of_slab[k] = static_cast<std::int32_t>(sections.count - 1);
    grains += slab_size[k];
    if (grains >= section_grains && k + 1 < slab_size.size()) {
      ++sections.count;
      grains = 0;
    }
  }
  if (sections.is_ring && sections.count % 2 == 1 && sections.count > 1) {
    --sections.count;
    for (std::int32_t& section : sections.of_slab) {
      section = std::min(section, static_cast<std::int32_t>(sections.count - 1));
    }
  }
}

/// Calls put(k, place) for items 0 .. count - 1, whose places follow one another section by
/// section: a counting sort, stable and linear. `begin`: first place of each section; one more at
/// the end.
template <class SectionOf, class Put>
void sort_by_section(const PartLoop& loop, std::size_t count, SectionOf section, Sections& sections,
                     std::vector<std::size_t>& begin, Put put) {
  const std::size_t parts = sections.count;
  std::vector<std::size_t>& place = sections.place;
  place.assign(parts * sections.count, 0);
  const auto visit = [&](const auto& work) {
    run_shares(loop, count, parts, [&](std::size_t part, Share share) {
      std::size_t* const own = place.data() + part * sections.count;
      for (std::size_t k = share.first; k < share.last; ++k) work(k, own[section(k)]);
    });
  };
  visit([](std::size_t, std::size_t& items) { ++items; });
  begin.assign(1, 0);
  for (std::size_t s = 0; s < sections.count; ++s) {
    std::size_t next = begin.back();
    for (std::size_t part = 0; part < parts; ++part) {
      next += std::exchange(place[part * sections.count + s], next);
    }
    begin.push_back(next);
  }
  visit([&](std::size_t k, std::size_t& next) { put(k, next++); });
}

void sort_pairs(const Candidates& candidates, const PartLoop& loop, Sections& sections) {
  const std::vector<GrainPair>& pairs = candidates.pairs;
  sections.pairs.resize(pairs.size());
  sort_by_section(
      loop, pairs.size(), [&](std::size_t k) { return sections.section_of(pairs[k]); }, sections,
      sections.begin, [&](std::size_t k, std::size_t place) { sections.pairs[place] = pairs[k]; });
}

void sort_grains(const PartLoop& loop, Sections& sections) {
  sections.grains.resize(sections.slab.size());
  sort_by_section(
      loop, sections.grains.size(),
      [&](std::size_t k) { return sections.section_of(static_cast<std::int32_t>(k)); }, sections,
      sections.first_grain,
      [&](std::size_t k, std::size_t place) {
        sections.grains[place] = static_cast<std::int32_t>(k);
      });
}

void leave_whole(const Candidates& candidates, Sections& sections) {
  sections.count = 1;
  sections.pairs.assign(candidates.pairs.begin(), candidates.pairs.end());
  sections.begin.assign({0, candidates.pairs.size()});
}

}  // namespace

std::size_t Sections::section_of(GrainPair pair) const {
  const std::size_t a = section_of(pair.a), b = section_of(pair.b);
  const std::size_t first = std::min(a, b), second = std::max(a, b);
  return is_ring && second - first + 1 == count && count > 2 ? second : first;
}

void divide(const SphereBed& bed, const Candidates& candidates, const PartLoop& loop,
            Sections& sections) {
  sections.is_ring = is_periodic(bed.box, bed.section_axis);
  if (bed.sections == 1) {
    leave_whole(candidates, sections);
    return;
  }
  count_slabs(bed, candidates, loop, sections);
  cut(sections);
  sort_pairs(candidates, loop, sections);
  sort_grains(loop, sections);
}

}  // namespace grainsweep
