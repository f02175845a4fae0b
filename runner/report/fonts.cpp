#include "runner/report/fonts.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <iterator>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "runner/machine.hpp"
#include "runner/sweep/text_lines.hpp"

namespace grainsweep {
namespace {

constexpr char32_t first_beyond_ascii = 0x80;

/// "a0-377" or "3c6"; anything else adds nothing.
void add_range(std::string_view text, Characters& ranges) {
  std::uint32_t first = 0, last = 0;
  const char* end = text.data() + text.size();
  auto [at, error] = std::from_chars(text.data(), end, first, 16);
  if (error != std::errc()) return;
  last = first;
  if (at != end && *at == '-') error = std::from_chars(at + 1, end, last, 16).ec;
  if (error == std::errc()) ranges.emplace_back(first, last);
}

/// Sorts the ranges and joins those that overlap or follow each other.
Characters joined_ranges(Characters ranges) {
  std::sort(ranges.begin(), ranges.end());
  Characters all;
  for (const auto& [first, last] : ranges) {
    if (all.empty() || first > all.back().second + 1) all.emplace_back(first, last);
    all.back().second = std::max(all.back().second, last);
  }
  return all;
}

bool is_known(char32_t character, const Characters& known) {
  const auto after =
      std::upper_bound(known.begin(), known.end(), character,
                       [](char32_t value, const auto& range) { return value < range.first; });
  return after != known.begin() && character <= std::prev(after)->second;
}

/// The code point of a character in UTF-8.
char32_t code_point(std::string_view character) {
  const auto lead = static_cast<unsigned char>(character.front());
  const unsigned bits_of_lead = character.size() == 1 ? 0x7Fu : 0x7Fu >> character.size();
  char32_t code = lead & bits_of_lead;
  for (const char byte : character.substr(1)) {
    code = (code << 6u) | (static_cast<unsigned char>(byte) & 0x3Fu);
  }
  return code;
}

}  // namespace

Characters characters_of_fonts(std::string_view list) {
  Characters ranges;
  for (std::string_view line : lines_of(list)) {
    const std::size_t format_end = std::min(line.find(' '), line.size());
    const std::string_view format = line.substr(0, format_end);
    if (format != "TrueType" && format != "CFF") continue;
    line.remove_prefix(std::min(format_end + 1, line.size()));
    while (!line.empty()) {
      const std::size_t end = std::min(line.find(' '), line.size());
      add_range(line.substr(0, end), ranges);
      line.remove_prefix(std::min(end + 1, line.size()));
    }
  }
  return joined_ranges(std::move(ranges));
}

Characters installed_characters() {
  const Said list = said_by("fc-list -f '%{fontformat} %{charset}\\n' 2>/dev/null");
  const Characters installed = characters_of_fonts(list.code == 0 ? list.text : "");
  return installed.empty() ? Characters{{0xA0, 0x52F}, {0x2010, 0x2027}} : installed;
}

std::string drawable(std::string_view text, const Characters& known) {
  std::string drawn;
  for (std::size_t at = 0; at < text.size();) {
    std::size_t end = at + 1;
    while (end < text.size() && !begins_character(text[end])) ++end;
    const std::string_view character = text.substr(at, end - at);
    const char32_t code = code_point(character);
    drawn += code < first_beyond_ascii || is_known(code, known) ? character : "?";
    at = end;
  }
  return drawn;
}

}  // namespace grainsweep
