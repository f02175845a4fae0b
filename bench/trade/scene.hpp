// The beds of a scene, settled from the same starts with many accuracies, as a sweep of bench/trade
// left them in its output folder.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bench/trade/paired.hpp"
#include "engine/dynamics/presets.hpp"
#include "runner/tables/groups.hpp"

namespace grainsweep::bench {

/// Parts of an accuracy by their names: "step" -> "0.2".
using Parts = std::map<std::string, std::string>;

/// The packings with one accuracy; those that did not settle have no values.
struct Setting {
  Parts parts;
  std::string preset;  ///< the preset that it is, if any
  std::string name;    ///< of that, or the nearest preset and what differs: "fast, step 0.28"
  int planned = 0, made = 0, settled = 0;
  std::vector<double> cpu_seconds;  ///< of all made
  ByStart solid_fraction, coordination, contact_ratio;
  ByStart force_square;  ///< mean square of a force between grains over the mean of its layer
  /// Solid fraction over the distance from a wall, as fit_decay takes it; none without walls. Both
  /// sides of a gap.
  std::map<int, std::vector<std::vector<double>>> layers;
  double bin_width = 0.0, half_gap = 0.0;  ///< of those, d
  std::optional<ProtocolBias> bound;       ///< as groups.csv prints it

  bool is_exact() const { return parts.at("rest") == "exact"; }
};

struct Scene {
  std::string name;
  std::vector<Setting> settings;  ///< in the order of the sweep; the first is the reference
  std::uint64_t seed = 0;         ///< of the sweep: other seeds make other starts
};

/// The setting with these parts; null if there is none.
const Setting* find_setting(const Scene& scene, const Parts& parts);

/// Names every setting by the preset, of the scene or not, from which it differs in the fewest
/// parts.
void name_settings(Scene& scene);

/// Throws BadInput if `folder` is no output folder, FileError if a file cannot be read.
Scene read_scene(const std::string& folder);

}  // namespace grainsweep::bench
