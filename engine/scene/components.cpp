#include "engine/scene/components.hpp"

#include "engine/scene/random.hpp"
#include "engine/shape/mixture.hpp"

namespace grainsweep {

std::vector<std::uint8_t> draw_components(const ShapeSpec& shape, std::size_t grains,
                                          std::uint64_t key) {
  std::vector<std::uint8_t> components;
  const auto* mixture = std::get_if<Mixture>(&shape);
  if (mixture == nullptr) return components;
  const auto counts = component_counts(number_shares(*mixture), static_cast<std::int64_t>(grains));
  for (std::size_t k = 0; k < counts.size(); ++k) {
    components.insert(components.end(), static_cast<std::size_t>(counts[k]),
                      static_cast<std::uint8_t>(k));
  }
  shuffle(key, Purpose::component, components);
  return components;
}

}  // namespace grainsweep
