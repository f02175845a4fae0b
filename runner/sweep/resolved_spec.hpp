// One point of a sweep while its parameters are being written into it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include "engine/scene/spec.hpp"
#include "runner/sweep/error_wish.hpp"

namespace grainsweep {

/// A component of a mixture as it is written.
struct WrittenComponent {
  double share = 0.0;
  ShapeSpec shape;
  double pinacoid_angle = 60.0;  ///< degrees, as ResolvedSpec::pinacoid_angle
  std::string text;              ///< share and shape as they identify a job, canonical JSON
  std::string hull_file = {};    ///< as ResolvedSpec::hull_file
  double hull_size = 1.0;        ///< as ResolvedSpec::hull_size

  /// File and size tell hulls apart until they are placed.
  auto identity() const { return std::tie(text, hull_file, hull_size); }
  bool operator==(const WrittenComponent& other) const { return identity() == other.identity(); }
  bool operator<(const WrittenComponent& other) const { return identity() < other.identity(); }
};
using Components = std::vector<WrittenComponent>;

/// A packing's specification, and what a sweep file says that the engine does not know.
struct ResolvedSpec {
  ResolvedSpec();

  PackingSpec spec;                     ///< random_key is not set here
  int preset = -1;                      ///< index into presets(), -1 for the default
  ErrorWish asked_accuracy;             ///< in place of a preset: the largest bias of settling
  std::string fill_file;                ///< as written; "" unless the fill is a file
  std::vector<std::string> fill_files;  ///< as written; empty unless each replicate has its own
  std::string fill_content;      ///< hash of the file's bytes, or of those of all, 16 hex digits
  double fill_diameter = 1.0;    ///< length in that file that is d here
  double pinacoid_angle = 60.0;  ///< degrees, as written; the specification holds it in radians
  Components mixture;            ///< of the shape, where that is a mixture
  ShareBy mixture_by = ShareBy::volume;
  std::string hull_file;          ///< as written; "" unless the shape is a hull from a file
  double hull_size = 1.0;         ///< length in the vertices of a hull that is d here
  bool has_size_formula = false;  ///< whether a distribution of sizes says more than its parts
  std::string size_file;          ///< as written; "" unless a table of sizes comes from a file
  double size_unit = 1.0;         ///< length in a distribution of sizes that is d here
  std::uint64_t seed = 0;         ///< master seed
};

/// The preset of a sweep that names none.
inline constexpr const char* default_preset = "balanced";

}  // namespace grainsweep
