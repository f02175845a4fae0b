// Named values of `Accuracy`, and what each promises.
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "engine/scene/spec.hpp"

namespace grainsweep {

/// Kinds of beds whose protocol's error was measured.
enum class BedKind {
  spheres,    ///< of one size, with and without walls, and in tubes
  two_sizes,  ///< spheres in boxes, the small ones half as large
  pinacoids,  ///< 1 by 1 by 1, in boxes
};

/// How far means over many beds lie at most from those of beds settled ever better.
struct ProtocolBias {
  double solid_fraction = 0.0;
  double coordination = 0.0;  ///< counted at measured_gap
};

/// Below which grains were neighbours where biases were measured, d. Beds that are not solved to
/// the end have contacts that are open by less, which others than this do not count alike.
inline constexpr double measured_gap = 1e-4;

struct Preset {
  std::string_view name;
  std::string_view promise;  ///< one sentence with numbers, for --help and the README
  Accuracy accuracy;
  std::array<std::optional<ProtocolBias>, 3> bias_bounds;  ///< by BedKind; none if not measured
};

/// fast, balanced, accurate, exact: the cheaper ones first, of those at rest in steps.
const std::vector<Preset>& presets();

/// The preset called `name`, if there is one.
std::optional<Accuracy> preset(std::string_view name);

/// Bound of the bias of that preset: the measured distance from the limit, or of spheres from exact
/// rest where that is larger, and two of its standard errors, of the worst scene of the kind
/// (bench/README.md, "The protocol's own error"); of exact rest from what half its path, half its
/// step and both come to. None for other names: what was not measured has no bound.
std::optional<ProtocolBias> bias_bound(std::string_view preset_name, BedKind kind);

/// The preset that an accuracy settles as, which has its bounds: it is one but for `precision`,
/// which changes no mean by more than its error (the same place), and for `max_steps`, which
/// changes no bed that settles. Empty if there is none.
std::string_view settles_as(const Accuracy& accuracy);

}  // namespace grainsweep
