#include "runner/sweep/text_lines.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <utility>

namespace grainsweep {
namespace {

constexpr std::size_t largest_file = std::size_t{256} << 20U;  // bytes

FileText refuse(const std::string& path, const std::string& message) {
  return {"", {{"", message, Anchor::value, path}}};
}

/// Whether the bytes are text of two bytes a character, as spreadsheets save "Unicode text": a mark
/// of the order of bytes, then a character whose other byte is zero.
bool is_utf_16(std::string_view bytes) {
  if (bytes.size() < 4) return false;
  const bool is_little = bytes.starts_with("\xFF\xFE") && bytes[3] == '\0';
  return is_little || (bytes.starts_with("\xFE\xFF") && bytes[2] == '\0');
}

/// Bytes of the character that `text` begins with if a terminal would obey it, else 0.
std::size_t bytes_of_control(std::string_view text) {
  const auto byte = [&](std::size_t at) {
    return at < text.size() ? static_cast<unsigned char>(text[at]) : 0U;
  };
  const auto lies_in = [](unsigned value, unsigned low, unsigned high) {
    return value >= low && value <= high;
  };
  if (byte(0) < 0x20 || byte(0) == 0x7f) return 1;
  if (byte(0) == 0xc2 && lies_in(byte(1), 0x80, 0x9f)) return 2;  // C1
  if (byte(0) != 0xe2) return 0;
  const bool is_mark = byte(1) == 0x80 && lies_in(byte(2), 0x8e, 0x8f);          // U+200E, F
  const bool is_line_or_turn = byte(1) == 0x80 && lies_in(byte(2), 0xa8, 0xae);  // U+2028 to E
  const bool is_isolate = byte(1) == 0x81 && lies_in(byte(2), 0xa6, 0xa9);       // U+2066 to 9
  return is_mark || is_line_or_turn || is_isolate ? 3 : 0;
}

}  // namespace

FileText read_text(const std::string& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) return refuse(path, "is a folder, not a file");
  const auto kind = std::filesystem::status(path, error).type();
  const bool is_there = kind != std::filesystem::file_type::not_found;
  if (!error && is_there && kind != std::filesystem::file_type::regular) {
    return refuse(path, "is a pipe or a device, not a file");
  }
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  if (!stream) return refuse(path, std::string("cannot be read: ") + std::strerror(errno));
  std::string text;
  std::array<char, 1 << 16> block{};
  while (stream.read(block.data(), block.size()) || stream.gcount() > 0) {
    text.append(block.data(), static_cast<std::size_t>(stream.gcount()));
    if (text.size() > largest_file) return refuse(path, "is larger than 256 MiB");
  }
  if (text.find_first_not_of(" \t\r\n") == std::string::npos) return refuse(path, "is empty");
  if (is_utf_16(text)) return refuse(path, "is text in UTF-16; save it as UTF-8");
  return {std::move(text), {}};
}

Diagnostic wrong_line(const std::string& file, std::size_t line, std::string message) {
  return {"", std::move(message), Anchor::value, file + ":" + std::to_string(line)};
}

void note_wrong_line(Diagnostics& errors, const std::string& file, std::size_t line,
                     std::string message) {
  const bool is_last = errors.size() + 1 == most_wrong_lines;
  if (is_last) message += " (further lines are not listed)";
  errors.push_back(wrong_line(file, line, std::move(message)));
}

std::string without_controls(std::string_view text) {
  std::string plain;
  while (!text.empty()) {
    const std::size_t bytes = bytes_of_control(text);
    plain += bytes > 0 ? '?' : text.front();
    text.remove_prefix(std::max<std::size_t>(bytes, 1));
  }
  return plain;
}

std::string lines_without_controls(std::string_view text) {
  std::string plain;
  for (const std::string_view line : pieces_of(text, '\n')) plain += without_controls(line) + "\n";
  plain.pop_back();
  return plain;
}

bool begins_character(char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) != 0x80U; }

std::size_t characters(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), begins_character));
}

bool begins_a_formula(std::string_view text) {
  return !text.empty() && std::string_view("=+-@").find(text.front()) != std::string_view::npos;
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::string separator_hint(std::string_view first_line) {
  const bool has_commas = first_line.find(',') != std::string_view::npos;
  if (has_commas || first_line.find_first_of(";\t") == std::string_view::npos) return "";
  return "; cells are separated by commas, and numbers have a decimal point";
}

std::string wrong_width(std::size_t cells, std::size_t width) {
  return "must hold " + std::to_string(width) + " values like the first line, holds " +
         std::to_string(cells);
}

std::optional<double> finite_number(std::string_view text) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

std::vector<std::string_view> pieces_of(std::string_view text, char separator) {
  std::vector<std::string_view> pieces;
  for (;;) {
    const std::size_t end = text.find(separator);
    pieces.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return pieces;
    text.remove_prefix(end + 1);
  }
}

std::vector<std::string_view> lines_of(std::string_view text) {
  if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
  const std::size_t end = text.find_last_not_of(" \t\r\n");
  text = text.substr(0, end == std::string_view::npos ? 0 : end + 1);
  const bool has_returns_alone = text.find('\n') == std::string_view::npos;
  return pieces_of(text, has_returns_alone ? '\r' : '\n');
}

LineCells cells_of(std::string_view line) {
  LineCells cells = pieces_of(line, ',');
  for (std::string_view& cell : cells) {
    cell = trimmed(cell);
    if (cell.size() > 1 && cell.front() == '"' && cell.back() == '"') {
      cell = cell.substr(1, cell.size() - 2);
    }
  }
  return cells;
}

LineIndex::LineIndex(const std::string& text) : size_(text.size()), starts_{0} {
  if (text.starts_with(byte_order_mark)) starts_.front() = byte_order_mark.size();
  for (std::size_t at = starts_.front(); at < text.size(); ++at) {
    if (text[at] == '\n') starts_.push_back(at + 1);
    if (!begins_character(text[at])) continuations_.push_back(at);
  }
}

std::string LineIndex::place(std::size_t offset) const {
  offset = std::clamp(offset, starts_.front(), size_);
  const auto next = std::upper_bound(starts_.begin(), starts_.end(), offset);
  const std::size_t begin = *(next - 1);
  const auto first = std::lower_bound(continuations_.begin(), continuations_.end(), begin);
  const auto last = std::lower_bound(first, continuations_.end(), offset);
  const std::size_t column = offset - begin - static_cast<std::size_t>(last - first) + 1;
  const std::string line = std::to_string(next - starts_.begin());
  return std::string(":").append(line).append(":").append(std::to_string(column));
}

}  // namespace grainsweep
