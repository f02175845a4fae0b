// "replicates" of a sweep or of a block: a number, or as many as a requested error takes.
#pragma once

#include <string>

#include "runner/sweep/diagnostic.hpp"
#include "runner/sweep/error_wish.hpp"
#include "runner/sweep/json_text.hpp"

namespace grainsweep {

inline constexpr int most_replicates = 10'000;
inline constexpr int usual_most_replicates = 200;  ///< of points that grow

/// How many packings of a point are made.
struct Replicates {
  int most = 1;
  ErrorWish wish = {};
  FitWish fit_wish = {};
  std::string wish_pointer = {};  ///< where the requested errors are written
};

/// Reads them from `object`, which `pointer` leads to; returns `otherwise` if it says nothing about
/// them, or something wrong, which is noted.
Replicates read_replicates(const Json& object, const std::string& pointer,
                           const Replicates& otherwise, Diagnostics& diagnostics);

}  // namespace grainsweep
