// Which kind a bed is, among those whose protocol error was measured.
#pragma once

#include <optional>
#include <string_view>

#include "engine/dynamics/presets.hpp"
#include "engine/scene/spec.hpp"

namespace grainsweep {

/// Whether its walls stand so near to each other that they order the grains: nearer than 4 d, in
/// ducts and tubes than 5 d. phi and Z go up and down with the width there, as layers fit or do
/// not.
bool is_narrow(const Box& box);
inline constexpr const char* narrow_containers = "(W < 4 d, ducts and tubes < 5 d)";

/// None for beds unlike any that was measured: starts from files; classes that spread more than
/// they usually do; small grains less than half as large as the others, or without others;
/// distributions whose largest grain is more than 3 times the smallest, but for lognormal ones with
/// a sigma of up to 0.5, and Weibull curves; other shapes, proportions and angles than those of the
/// usual pinacoid; for other grains than spheres of one size, gaps between walls of less than 4 d,
/// and ducts and tubes of less than 5 d; and for pinacoids all tubes.
std::optional<BedKind> bed_kind(const PackingSpec& spec);

/// "spheres of one size".
const char* name_of(BedKind kind);

/// The kind of that name, if there is one.
std::optional<BedKind> bed_kind_called(std::string_view name);

}  // namespace grainsweep
