// One point of a sweep while its parameters are being written into it.
#pragma once

#include <cstdint>
#include <string>

#include "engine/scene/spec.hpp"

namespace grainsweep {

/// Shapes a bed can be packed from.
enum class Shape { sphere };

/// A packing's specification, and what a sweep file says that the engine does not know.
struct Draft {
  Draft();

  Shape shape = Shape::sphere;
  PackingSpec spec;            ///< random_key is not set here
  int preset = -1;             ///< index into presets(), -1 for the default
  std::string fill_file;       ///< as written; "" unless the fill is a file
  std::string fill_content;    ///< hash of that file's bytes, 16 hex digits
  double fill_diameter = 1.0;  ///< length in that file that is d here
  std::uint64_t seed = 0;      ///< master seed
};

/// The preset of a sweep that names none.
inline constexpr const char* default_preset = "balanced";

}  // namespace grainsweep
