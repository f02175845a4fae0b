// Named values of `Accuracy`, and what each promises.
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "engine/scene/spec.hpp"

namespace grainsweep {

/// Kinds of beds for which the protocol's error was measured.
enum class BedKind {
  spheres,         ///< of one size, with and without walls, and in tubes
  narrow_spheres,  ///< the same between walls less than 4 d apart, in ducts and tubes of less than
                   ///< 5 d
  two_sizes,       ///< spheres in boxes, the small ones half as large
  narrow_two_sizes,  ///< the same between walls 2 to 4 d apart, in ducts of 2 to 5 d and in tubes
                     ///< of 3 to 5 d
  many_sizes,        ///< spheres of other sizes, in boxes and tubes that are not narrow
  pinacoids,         ///< 1 by 1 by 1, in boxes
  narrow_pinacoids,  ///< the same between walls 2 to 4 d apart, and in ducts of 2.5 to 5 d
};
inline constexpr std::size_t bed_kinds = 7;

/// Largest distance of means over many beds from their limit as beds are settled ever better.
struct ProtocolBias {
  double solid_fraction = 0.0;
  double coordination = 0.0;  ///< counted at measured_gap
};

/// Gap below which grains counted as neighbours where biases were measured, d. Beds that are not
/// solved to the end have contacts that are open by less; other gap tolerances count these
/// differently.
inline constexpr double measured_gap = 1e-4;

struct Preset {
  std::string_view name;
  std::string_view promise;  ///< one sentence with numbers, for --help and the README
  Accuracy accuracy;
  std::array<std::optional<ProtocolBias>, bed_kinds>
      bias_bounds;  ///< by BedKind; none if not measured
};

/// fast, balanced, accurate, exact: of those at rest in steps, the cheaper ones first.
const std::vector<Preset>& presets();

/// The preset called `name`, if there is one.
std::optional<Accuracy> preset(std::string_view name);

/// Bound of the bias of that preset: the measured distance from the limit (for spheres from exact
/// rest where that is larger) and two of its standard errors, for the worst scene of the kind
/// (bench/README.md, "The protocol's own error"). For exact rest the distance is that from the
/// results of half its path, half its step and both. None for other names: what was not measured
/// has no bound.
std::optional<ProtocolBias> bias_bound(std::string_view preset_name, BedKind kind);

/// The preset whose bounds hold for an accuracy: the one that it equals except for `precision`,
/// which changes no mean by more than its error (the same place), and `max_steps`, which changes no
/// bed that settles. Empty if there is none.
std::string_view settles_as(const Accuracy& accuracy);

}  // namespace grainsweep
