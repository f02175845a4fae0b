// Ways to run the parts of a large bed's work, all of which must give the same bits.
#pragma once

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

#include "engine/context.hpp"

namespace grainsweep::testing {

inline void last_part_first(std::size_t parts, const std::function<void(std::size_t)>& part) {
  for (std::size_t k = parts; k-- > 0;) part(k);
}

/// Two threads that take parts as they come.
inline void two_threads(std::size_t parts, const std::function<void(std::size_t)>& part) {
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t k = next++; k < parts; k = next++) part(k);
  };
  std::thread other(work);
  work();
  other.join();
}

}  // namespace grainsweep::testing
