#include "engine/contact/sections.hpp"

#include <algorithm>

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

std::size_t section_of(const Candidates& candidates, const Sections& sections, GrainPair pair) {
  const auto section = [&](std::int32_t grain) {
    return sections
        .of_layer[static_cast<std::size_t>(candidates.layer[static_cast<std::size_t>(grain)])];
  };
  return static_cast<std::size_t>(std::min(section(pair.a), section(pair.b)));
}

/// A counting sort: stable, linear.
void sort_pairs(const Candidates& candidates, Sections& sections) {
  sections.begin.assign(sections.count + 2, 0);
  for (const GrainPair pair : candidates.pairs) {
    ++sections.begin[section_of(candidates, sections, pair) + 2];
  }
  for (std::size_t k = 2; k < sections.begin.size(); ++k) {
    sections.begin[k] += sections.begin[k - 1];
  }
  sections.pairs.resize(candidates.pairs.size());
  for (const GrainPair pair : candidates.pairs) {
    sections.pairs[sections.begin[section_of(candidates, sections, pair) + 1]++] = pair;
  }
}

}  // namespace

void divide(const Candidates& candidates, Sections& sections) {
  if (most_sections(candidates.layer.size()) == 1) {
    sections.count = 1;
    sections.pairs.assign(candidates.pairs.begin(), candidates.pairs.end());
    sections.begin.assign({0, candidates.pairs.size()});
    return;
  }
  count_layers(candidates, sections.layer_size);
  cut(sections.layer_size, sections);
  sort_pairs(candidates, sections);
}

}  // namespace grainsweep
