// Which kind a bed is, among those whose protocol error was measured.
#pragma once

#include <optional>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

#include "engine/dynamics/presets.hpp"
#include "engine/scene/box.hpp"

namespace grainsweep {

/// By the name of its grains' shape, its container, the share of small grains, and its canonical
/// parameters; none for beds unlike any that was measured: distributions of sizes, starts from
/// files, small grains that are not half as large or have no large ones beside them, sizes that
/// spread more than they usually do, other shapes, proportions and angles, and, for other grains
/// than spheres of one size, tubes, gaps between walls of less than 4 d and ducts of less than 5 d.
std::optional<BedKind> bed_kind(std::string_view shape, const Box& box, double small_share,
                                const nlohmann::json& parameters);

/// "spheres of one size".
const char* name_of(BedKind kind);

}  // namespace grainsweep
