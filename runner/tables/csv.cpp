#include "runner/tables/csv.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "runner/text.hpp"

namespace grainsweep {

std::string cell(double value) {
  if (!std::isfinite(value)) return "";
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return {text.data(), end};
}

double without_noise(double value, int digits) {
  if (!std::isfinite(value)) return value;
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value,
                                 std::chars_format::scientific, digits - 1)
                       .ptr;
  std::from_chars(text.data(), end, value);
  return value;
}

std::string short_cell(double value, int digits) { return cell(without_noise(value, digits)); }

std::string cell(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

std::string unquoted(const std::string& cell) {
  if (cell.size() < 2 || cell.front() != '"') return cell;
  std::string text;
  for (std::size_t k = 1; k + 1 < cell.size(); ++k) {
    text += cell[k];
    if (cell[k] == '"') ++k;
  }
  return text;
}

std::string short_number(double value) {
  constexpr int digits = 4;
  if (value == 0.0 || !std::isfinite(value)) return cell(value);
  const int before_point = static_cast<int>(std::floor(std::log10(std::abs(value)))) + 1;
  std::string text = fixed(value, std::max(digits - before_point, 0));
  if (text.find('.') == std::string::npos) return text;
  text.erase(text.find_last_not_of('0') + 1);
  if (text.ends_with('.')) text.pop_back();
  return text;
}

std::string with_readable_numbers(const std::string& cell) {
  constexpr std::ptrdiff_t most_digits = 6;
  const bool is_list = cell.starts_with('[') && cell.find('"') == std::string::npos;
  const char *at = cell.data(), *const last = cell.data() + cell.size();
  std::string text;
  while (at != last) {
    double value = 0.0;
    const auto [end, error] = std::from_chars(at, last, value);
    if (!is_list && (error != std::errc() || end != last)) return cell;
    if (error != std::errc()) {
      text += *at++;
      continue;
    }
    const char* const first_digit =
        std::find_if(at, end, [](char c) { return c > '0' && c <= '9'; });
    const auto digits = std::count_if(first_digit, std::find(at, end, 'e'),
                                      [](char c) { return c >= '0' && c <= '9'; });
    text += digits > most_digits ? short_number(value) : std::string(at, end);
    at = end;
  }
  return text;
}

std::string csv_line(const std::vector<std::string>& cells) {
  std::string line;
  for (const std::string& text : cells) {
    if (&text != &cells.front()) line += ',';
    line += text;
  }
  return line + '\n';
}

}  // namespace grainsweep
