#include "runner/sweep/json_text.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <system_error>
#include <unordered_map>

#include "runner/sweep/json_places.hpp"

namespace grainsweep {
namespace {

constexpr std::size_t largest_file = std::size_t{256} << 20U;  // bytes

/// Takes every event of a parse and keeps only its first error.
struct SyntaxListener final : nlohmann::json_sax<Json> {
  std::size_t bytes_read = 0;
  std::string complaint;

  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(number_integer_t) override { return true; }
  bool number_unsigned(number_unsigned_t) override { return true; }
  bool number_float(number_float_t, const string_t&) override { return true; }
  bool string(string_t&) override { return true; }
  bool binary(binary_t&) override { return true; }
  bool start_object(std::size_t) override { return true; }
  bool key(string_t&) override { return true; }
  bool end_object() override { return true; }
  bool start_array(std::size_t) override { return true; }
  bool end_array() override { return true; }
  bool parse_error(std::size_t position, const std::string&,
                   const nlohmann::detail::exception& error) override {
    bytes_read = position;
    complaint = error.what();
    return false;
  }
};

bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; }
bool is_number_or_word(char c) { return is_word(c) || c == '+' || c == '-' || c == '.'; }

/// Start of the word or number that holds the byte at `at`.
std::size_t word_start(const std::string& text, std::size_t at) {
  if (at >= text.size() || !is_number_or_word(text[at])) return at;
  while (at > 0 && is_number_or_word(text[at - 1])) --at;
  return at;
}

bool is_nan_or_infinity(std::string_view word) {
  if (word.starts_with('-') || word.starts_with('+')) word.remove_prefix(1);
  std::string lower;
  for (const char c : word.substr(0, sizeof "infinity")) {
    if (!is_word(c)) break;
    lower += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return lower == "nan" || lower == "inf" || lower == "infinity";
}

char last_before(const std::string& text, std::size_t at) {
  const std::size_t found = at == 0 ? at : text.find_last_not_of(" \t\r\n", at - 1);
  return found < at ? text[found] : '\0';
}

bool has(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

/// The parser's own words behind "syntax error while parsing ...".
std::string plain(const std::string& complaint) {
  const std::size_t dash = complaint.find(" - ");
  std::string words = dash == std::string::npos ? complaint : complaint.substr(dash + 3);
  return words.substr(0, words.find("; last read"));
}

std::string syntax_message(const std::string& text, std::size_t at, const std::string& complaint) {
  const char c = at < text.size() ? text[at] : '\0';
  if (has(complaint, "ill-formed UTF-8")) return "is not UTF-8 text here; save the file as UTF-8";
  if (has(complaint, "number overflow")) return "this number is too large for a 64-bit float";
  if (at >= text.size()) return "the file ends too early: a bracket or a quote is not closed";
  if (is_nan_or_infinity(std::string_view(text).substr(at))) {
    return "JSON has no NaN and no Infinity; write a finite number";
  }
  if (c == '\'') return "a string needs double quotes";
  if (c == '/' || c == '#') return "JSON has no comments; remove it";
  if ((c == '}' || c == ']') && last_before(text, at) == ',') {
    return std::string("remove the comma before this '") + c + "'";
  }
  return "malformed JSON: " + plain(complaint);
}

std::vector<Finding> syntax_errors(const std::string& text, const std::string& file) {
  SyntaxListener listener;
  if (Json::sax_parse(text, &listener)) return {};
  const std::size_t read = std::max<std::size_t>(listener.bytes_read, 1);
  const std::size_t at = word_start(text, read - 1);
  return {{file + LineIndex(text).place(at), "", syntax_message(text, at, listener.complaint)}};
}

/// Counts brackets outside strings; needs no valid JSON and no stack.
std::vector<Finding> depth_errors(const std::string& text, const std::string& file) {
  int depth = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '"') in_string = !in_string;
    if (in_string && text[i] == '\\') ++i;
    if (in_string || i >= text.size()) continue;
    if (text[i] == ']' || text[i] == '}') --depth;
    if ((text[i] == '[' || text[i] == '{') && ++depth > deepest_json) {
      const std::string most = std::to_string(deepest_json);
      return {{file + LineIndex(text).place(i), "", "is nested deeper than " + most + " levels"}};
    }
  }
  return {};
}

std::vector<Finding> duplicate_errors(const std::string& text, const std::string& file) {
  const LineIndex lines(text);
  std::unordered_map<std::string, std::size_t> first;
  std::vector<Finding> errors;
  for_each_value(text, [&](const JsonPlace& place) {
    if (!place.is_member) return;
    const auto [entry, is_new] = first.emplace(place.pointer, place.key);
    if (is_new) return;
    errors.push_back({file + lines.place(place.key), place.pointer,
                      "the same key is already written at " + lines.place(entry->second).substr(1) +
                          "; keep one of them"});
  });
  return errors;
}

FileText refuse(const std::string& path, const std::string& message) {
  return {"", {{path, "", message}}};
}

}  // namespace

FileText read_text(const std::string& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) return refuse(path, "is a folder, not a file");
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
  return {std::move(text), {}};
}

JsonReading parse_strictly(const std::string& text, const std::string& file) {
  JsonReading reading;
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) {
    reading.errors = {{file + ":1:1", "", "is UTF-16 text; save the file as UTF-8"}};
    return reading;
  }
  reading.errors = depth_errors(text, file);
  if (reading.errors.empty()) reading.errors = syntax_errors(text, file);
  if (reading.errors.empty()) reading.errors = duplicate_errors(text, file);
  if (reading.errors.empty()) reading.value = Json::parse(text);
  return reading;
}

}  // namespace grainsweep
