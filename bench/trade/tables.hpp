// The trade of a scene as tables: for its README, and for the picture.
#pragma once

#include <string>
#include <vector>

#include "bench/trade/comparison.hpp"

namespace grainsweep::bench {

/// A scene with its settings compared; rows refer to the scene.
struct SceneRows {
  const Scene* scene = nullptr;
  std::vector<Compared> rows;
};

/// "-0.0012 +- 0.0002"; "-" if there is none.
std::string difference_text(const MeanError& difference, int decimals);

/// Markdown: the reference and a row for each setting; the presets beside their bounds; and what
/// the search for exact rest changes. A scene that is not whole says so.
std::string trade_markdown(const SceneRows& compared);

/// A line for each setting.
std::string trade_csv(const SceneRows& compared);

}  // namespace grainsweep::bench
