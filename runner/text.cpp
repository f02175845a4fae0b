#include "runner/text.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <sstream>

#include "runner/sweep/text_lines.hpp"

namespace grainsweep {

std::string pad_left(const std::string& text, std::size_t width) {
  const std::size_t length = characters(text);
  return std::string(width > length ? width - length : 0, ' ') + text;
}

std::string pad_right(const std::string& text, std::size_t width) {
  return text + pad_left(text, width).substr(0, pad_left(text, width).size() - text.size());
}

std::string filled_lines(const std::string& text, std::size_t width) {
  std::istringstream words(text);
  std::string filled, word;
  std::size_t used = 0;  // characters of the last line
  while (words >> word) {
    const std::size_t length = characters(word);
    const bool has_room = used + 1 + length <= width;
    if (used > 0) filled += has_room ? ' ' : '\n';
    used = used > 0 && has_room ? used + 1 + length : length;
    filled += word;
  }
  return filled;
}

std::string replaced(std::string text, std::string_view from, std::string_view to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at)) {
    text.replace(at, from.size(), to);
    at += to.size();
  }
  return text;
}

std::string counted(std::size_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

std::string fixed(double value, int decimals) {
  if (!std::isfinite(value)) return "-";
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
  return text.data();
}

std::string fixed_or_power(double value, int decimals) {
  constexpr double many = 1e4;
  return std::abs(value) < many ? fixed(value, decimals) : power_text(value);
}

std::string with_error(double value, double error, int decimals) {
  constexpr int most_more = 4;
  constexpr double rounding = 1e-12;  // of values that are all the same
  const bool is_error = error > rounding * std::abs(value);
  for (int more = 0; more < most_more && is_error && error < 0.5 * std::pow(10.0, -decimals);
       ++more) {
    ++decimals;  // so that no error is printed as zero
  }
  const std::string text = fixed(value, decimals);
  return std::isfinite(error) ? text + " ± " + fixed(error, decimals) : text;
}

std::string size_text(std::size_t bytes) {
  const double kilobytes = static_cast<double>(bytes) / 1e3;
  if (kilobytes < 999.5) return fixed(std::max(1.0, kilobytes), 0) + " kB";
  return fixed(kilobytes / 1e3, 1) + " MB";
}

std::string power_text(double value) {
  if (!std::isfinite(value)) return "-";
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.1e", value);
  return text.data();
}

std::string shell_word(const std::string& word) {
  const auto is_plain = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
           std::string_view("-_./,:=+@%").find(c) != std::string_view::npos;
  };
  if (!word.empty() && std::all_of(word.begin(), word.end(), is_plain)) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string shell_path(const std::string& path) {
  return shell_word((path.starts_with('-') ? "./" : "") + path);
}

std::string duration_text(double seconds) {
  const long whole = std::lround(std::max(0.0, seconds));
  if (seconds < 9.95) return fixed(seconds, 2) + " s";
  if (whole < 60) return fixed(seconds, 1) + " s";
  if (whole < 3600) return std::to_string(whole / 60) + " min " + std::to_string(whole % 60) + " s";
  return std::to_string(whole / 3600) + " h " + std::to_string(whole / 60 % 60) + " min";
}

}  // namespace grainsweep
