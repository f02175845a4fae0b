#include "engine/shape/mixture.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/shape/given_shape.hpp"
#include "engine/text.hpp"

namespace grainsweep {

namespace {

constexpr double share_rounding = 0.001;  // of shares written with three digits

std::string problem_with_component(const MixtureComponent& component) {
  if (!(component.share >= 0.0 && component.share <= 1.0)) {
    return "its share must lie in [0, 1], is " + bound_text(component.share);
  }
  if (std::holds_alternative<Mixture>(component.shape)) return "must not be a mixture itself";
  return shape_of(component.shape).error;
}

}  // namespace

std::string problem_with(const Mixture& mixture) {
  const auto& components = mixture.components;
  if (components.empty() || components.size() > most_components) {
    return joined("must hold 1 to ", most_components, " components, holds ", components.size());
  }
  double whole = 0.0;
  for (const MixtureComponent& component : components) {
    const std::string problem = problem_with_component(component);
    if (!problem.empty()) {
      const auto number = static_cast<std::size_t>(&component - components.data()) + 1;
      return joined("component ", number, " (", name_of(component.shape), ") ", problem);
    }
    whole += component.share;
  }
  if (std::abs(whole - 1.0) <= share_rounding) return "";
  return "shares must add up to 1, add up to " + number_text(whole);
}

std::vector<ConvexShape> shapes_of(const ShapeSpec& spec) {
  std::vector<ConvexShape> shapes;
  if (const auto* mixture = std::get_if<Mixture>(&spec)) {
    for (const MixtureComponent& component : mixture->components) {
      shapes.push_back(*shape_of(component.shape).shape);
    }
  } else {
    shapes.push_back(*shape_of(spec).shape);
  }
  return shapes;
}

std::vector<double> number_shares(const Mixture& mixture) {
  std::vector<double> shares;
  for (const MixtureComponent& component : mixture.components) {
    const double one = mixture.by == ShareBy::volume ? extent_of(component.shape).volume : 1.0;
    shares.push_back(component.share / one);
  }
  const double whole = std::accumulate(shares.begin(), shares.end(), 0.0);
  for (double& share : shares) share /= whole;
  return shares;
}

std::vector<std::int64_t> component_counts(const std::vector<double>& shares, std::int64_t grains) {
  std::vector<std::int64_t> counts;
  std::vector<double> remainders;
  std::int64_t missing = grains;
  for (const double share : shares) {
    const double exact = share * static_cast<double>(grains);
    counts.push_back(std::min(static_cast<std::int64_t>(std::floor(exact)), missing));
    remainders.push_back(exact - static_cast<double>(counts.back()));
    missing -= counts.back();
  }
  for (; missing > 0; --missing) {
    const auto largest = std::max_element(remainders.begin(), remainders.end());
    ++counts[static_cast<std::size_t>(largest - remainders.begin())];
    *largest -= 1.0;
  }
  return counts;
}

}  // namespace grainsweep
