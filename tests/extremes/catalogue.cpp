#include "tests/extremes/catalogue.hpp"

#include <iterator>

namespace grainsweep::extremes {

std::vector<Scene> catalogue() {
  std::vector<Scene> all;
  for (const auto& family :
       {towers, masses, starts, accuracies, boxes, sweep_files, units, exact_answers, symmetries,
        energies, not_numbers, polyhedron_pairs, stacks}) {
    std::vector<Scene> scenes = family();
    std::move(scenes.begin(), scenes.end(), std::back_inserter(all));
  }
  return all;
}

}  // namespace grainsweep::extremes
