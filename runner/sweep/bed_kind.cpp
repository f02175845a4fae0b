#include "runner/sweep/bed_kind.hpp"

#include <string>

#include <nlohmann/json.hpp>

#include "engine/scene/spec.hpp"

namespace grainsweep {
namespace {

using nlohmann::json;

/// Whether the parameters hold this number at this place, "/sizes/size_ratio".
bool is_at(const json& parameters, const std::string& place, double value) {
  const json::json_pointer pointer(place);
  return parameters.contains(pointer) && parameters.at(pointer) == value;
}

/// Whether its walls stand so near to each other that they order the grains.
bool is_narrow(const Box& box) {
  constexpr double narrow_gap = 4.0, narrow_duct = 5.0;  // d
  return nearest_walls(box) < (is_walled_around(box) ? narrow_duct : narrow_gap);
}

}  // namespace

std::optional<BedKind> bed_kind(std::string_view shape, const Box& box, double small_share,
                                const json& parameters) {
  for (const char* place : {"/sizes/distribution", "/fill/file", "/fill/files"}) {
    if (parameters.contains(json::json_pointer(place))) return std::nullopt;
  }
  const json::json_pointer spread("/sizes/spread");
  const bool is_spread_more =
      parameters.contains(spread) && parameters.at(spread) > SizesSpec{}.spread;
  if (is_spread_more || small_share == 1.0) return std::nullopt;
  if (shape == "sphere" && small_share == 0.0) {
    return is_narrow(box) ? BedKind::narrow_spheres : BedKind::spheres;
  }
  if (box.is_tube || is_narrow(box)) return std::nullopt;
  if (shape == "sphere" && is_at(parameters, "/sizes/size_ratio", SizesSpec{}.size_ratio)) {
    return BedKind::two_sizes;
  }
  const PinacoidSize isometric;
  constexpr double usual_angle = 60.0;  // degrees
  const std::string pinacoid = "/shape/pinacoid/";
  if (shape == "pinacoid" && small_share == 0.0 &&
      is_at(parameters, pinacoid + "length", isometric.length) &&
      is_at(parameters, pinacoid + "width", isometric.width) &&
      is_at(parameters, pinacoid + "height", isometric.height) &&
      is_at(parameters, pinacoid + "angle_deg", usual_angle)) {
    return BedKind::pinacoids;
  }
  return std::nullopt;
}

const char* name_of(BedKind kind) {
  switch (kind) {
    case BedKind::spheres:
      return "spheres of one size";
    case BedKind::narrow_spheres:
      return "spheres of one size in narrow gaps, ducts or tubes";
    case BedKind::two_sizes:
      return "spheres of two sizes, 1 to 2";
    case BedKind::pinacoids:
      return "pinacoids 1 by 1 by 1";
  }
  return "";
}

}  // namespace grainsweep
