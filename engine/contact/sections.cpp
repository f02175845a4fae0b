#include "engine/contact/sections.hpp"

#include <algorithm>
#include <utility>

namespace grainsweep {

namespace {

void count_layers(const Candidates& candidates, std::vector<std::size_t>& layer_size) {
  layer_size.assign(candidates.layers.size(), 0);
  for (const std::int32_t layer : candidates.layer) {
    ++layer_size[static_cast<std::size_t>(layer)];
  }
}

/// From below: a section ends with the layer that fills it, unless that is the last one.
void cut(const std::vector<std::size_t>& layer_size, Sections& sections) {
  const std::size_t layers = layer_size.size();
  sections.of_layer.assign(layers, 0);
  sections.count = 1;
  std::size_t grains = 0;
  for (std::size_t k = 0; k < layers; ++k) {
    sections.of_layer[k] = static_cast<std::int32_t>(sections.count - 1);
    grains += layer_size[k];
    if (grains >= section_grains && k + 1 < layers) {
      ++sections.count;
      grains = 0;
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
    run_parts(loop, parts, [&](std::size_t part) {
      const Share share = share_of(count, part, parts);
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
  const auto section = [&](std::size_t k) {
    return std::min(section_of(candidates, sections, pairs[k].a),
                    section_of(candidates, sections, pairs[k].b));
  };
  sort_by_section(loop, pairs.size(), section, sections, sections.begin,
                  [&](std::size_t k, std::size_t place) { sections.pairs[place] = pairs[k]; });
}

void sort_grains(const Candidates& candidates, const PartLoop& loop, Sections& sections) {
  sections.grains.resize(candidates.layer.size());
  const auto section = [&](std::size_t k) {
    return section_of(candidates, sections, static_cast<std::int32_t>(k));
  };
  sort_by_section(loop, sections.grains.size(), section, sections, sections.first_grain,
                  [&](std::size_t k, std::size_t place) {
                    sections.grains[place] = static_cast<std::int32_t>(k);
                  });
}

}  // namespace

void divide(const Candidates& candidates, const PartLoop& loop, Sections& sections) {
  if (most_sections(candidates.layer.size()) == 1) {
    sections.count = 1;
    sections.of_layer.assign(candidates.layers.size(), 0);
    sections.pairs.assign(candidates.pairs.begin(), candidates.pairs.end());
    sections.begin.assign({0, candidates.pairs.size()});
    return;
  }
  count_layers(candidates, sections.layer_size);
  cut(sections.layer_size, sections);
  sort_pairs(candidates, loop, sections);
  sort_grains(candidates, loop, sections);
}

}  // namespace grainsweep
