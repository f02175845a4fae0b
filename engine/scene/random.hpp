// Random numbers by content: a number is a pure function of the packing's key, what it is for, the
// grain it belongs to and how often that grain asked. No state, so no order of drawing matters.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <Random123/philox.h>

#include "engine/portable.hpp"
#include "engine/units.hpp"

namespace grainsweep {

/// What a random number is for.
enum class Purpose : std::uint32_t {
  size = 1,
  place = 2,
  orientation = 3,
  component = 4,
  order = 5
};

/// Four independent 32-bit words.
inline r123::Philox4x32::ctr_type random_words(std::uint64_t key, Purpose purpose,
                                               std::uint64_t grain, std::uint32_t attempt) {
  const r123::Philox4x32::ctr_type counter = {{static_cast<std::uint32_t>(grain),
                                               static_cast<std::uint32_t>(grain >> 32), attempt,
                                               static_cast<std::uint32_t>(purpose)}};
  const r123::Philox4x32::key_type split = {
      {static_cast<std::uint32_t>(key), static_cast<std::uint32_t>(key >> 32)}};
  return r123::Philox4x32()(counter, split);
}

/// A 32-bit word as a number in (0, 1).
inline double unit_interval(std::uint32_t word) {
  return (static_cast<double>(word) + 0.5) * 0x1p-32;
}

/// Puts the entries into random order (Fisher and Yates).
template <class Entry>
void shuffle(std::uint64_t key, Purpose purpose, std::vector<Entry>& entries) {
  for (std::size_t i = entries.size(); i-- > 1;) {
    const double place = unit_interval(random_words(key, purpose, i, 0)[0]);
    std::swap(entries[i], entries[static_cast<std::size_t>(place * static_cast<double>(i + 1))]);
  }
}

/// A standard normal number from two words (Box and Muller 1958).
inline double standard_normal(std::uint32_t a, std::uint32_t b) {
  return std::sqrt(-2.0 * portable::log(unit_interval(a))) *
         portable::cos(2.0 * pi * unit_interval(b));
}

}  // namespace grainsweep
