// How many tries a test makes of what it tries many times.
#pragma once

namespace grainsweep::testing {

/// Whether the test was built with sanitizers. They watch what code does with memory and numbers,
/// which the first tries show, and make each try take five to ten times as long.
#ifdef GRAINSWEEP_SANITIZED
inline constexpr bool is_sanitized = true;
#else
inline constexpr bool is_sanitized = false;
#endif

/// `all` tries, or under sanitizers a quarter of them, at least one.
template <class Count>
constexpr Count tries(Count all) {
  return is_sanitized ? (all + 3) / 4 : all;
}

}  // namespace grainsweep::testing
