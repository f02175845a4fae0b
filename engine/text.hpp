// Numbers and words put into the engine's messages.
#pragma once

#include <charconv>
#include <cmath>
#include <cstdint>
#include <sstream>
#include <string>

namespace grainsweep {

/// `value` to `digits` significant digits, without trailing zeros.
inline std::string number_text(double value, int digits = 3) {
  char text[32];
  const auto end =
      std::to_chars(text, text + sizeof text, value, std::chars_format::general, digits);
  return {text, end.ptr};
}

/// The same to six digits; a whole number with all its digits.
inline std::string bound_text(double value) {
  if (std::isfinite(value) && value == std::floor(value) && std::abs(value) < 1e15) {
    return std::to_string(static_cast<std::int64_t>(value));
  }
  return number_text(value, 6);
}

/// A positive least value that is to be typed in: the same, but never below the value itself.
inline std::string least_text(double value) {
  std::string text = bound_text(value);
  double printed = 0.0;
  std::from_chars(text.data(), text.data() + text.size(), printed);
  if (printed >= value) return text;
  const double sixth_digit = std::pow(10.0, std::floor(std::log10(value)) - 5.0);
  return number_text(value + sixth_digit / 2.0, 6);
}

/// All parts, one after the other, as streams print them.
template <class... Parts>
std::string joined(const Parts&... parts) {
  std::ostringstream text;
  (text << ... << parts);
  return text.str();
}

}  // namespace grainsweep
