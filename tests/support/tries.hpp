// How much a test tries of what is tried many times.
#pragma once

namespace grainsweep::testing {

/// Whether the test was built with sanitizers. They watch what code does with memory and numbers,
/// which the first tries show, and what is tried takes them five to ten times as long.
#ifdef GRAINSWEEP_SANITIZED
inline constexpr bool is_sanitized = true;
#else
inline constexpr bool is_sanitized = false;
#endif

/// So many of `all` tries, or under sanitizers a quarter, and one at least.
template <class Count>
constexpr Count tries(Count all) {
  return is_sanitized ? (all + 3) / 4 : all;
}

}  // namespace grainsweep::testing
