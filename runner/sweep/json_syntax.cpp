#include "runner/sweep/json_syntax.hpp"

#include <cctype>
#include <string_view>

#include "runner/sweep/suggest.hpp"

namespace grainsweep {
namespace {

bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }
bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; }
bool is_number_or_word(char c) { return is_word(c) || c == '+' || c == '-' || c == '.'; }

/// Start of the word or number that holds the byte at `at`.
std::size_t word_start(std::string_view text, std::size_t at) {
  if (at >= text.size() || !is_number_or_word(text[at])) return at;
  while (at > 0 && is_number_or_word(text[at - 1])) --at;
  return at;
}

/// The word or number that starts at `at`.
std::string word_at(std::string_view text, std::size_t at) {
  std::size_t end = at;
  while (end < text.size() && is_number_or_word(text[end])) ++end;
  return std::string(text.substr(at, end - at));
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

char last_before(std::string_view text, std::size_t at) {
  const std::size_t found = text.substr(0, at).find_last_not_of(" \t\r\n");
  return found == std::string_view::npos ? '\0' : text[found];
}

bool has(std::string_view text, std::string_view part) {
  return text.find(part) != std::string_view::npos;
}

/// The parser's own words after "syntax error while parsing ...".
std::string plain(const std::string& complaint) {
  const std::size_t dash = complaint.find(" - ");
  std::string words = dash == std::string::npos ? complaint : complaint.substr(dash + 3);
  return words.substr(0, words.find("; last read"));
}

/// A number as other languages write it, and as JSON does; "" if it is not that.
std::string number_message(std::string_view text, std::size_t at) {
  const std::string word = word_at(text, at);
  const bool is_number = word.find_first_not_of("0123456789+-.eE") == std::string::npos;
  const auto digit = [&](std::size_t i) { return i < word.size() && is_digit(word[i]); };
  const auto write = [](const std::string& number) { return "write this number as " + number; };
  if (!is_number || word.empty()) return "";
  if (word[0] == '.' && digit(1)) return write("0" + word);
  if (word[0] == '-' && word.size() > 2 && word[1] == '.') return write("-0" + word.substr(1));
  if (word[0] == '+' && digit(1)) return write(word.substr(1));
  if (word.back() == '.' && digit(word.size() - 2)) return write(word + "0");
  if (word[0] == '0' && digit(1)) return "a number must not begin with 0";
  return "";
}

/// "9,95" where a key should be; "" if it is not that.
std::string decimal_comma_message(std::string_view text, std::size_t at) {
  const bool is_decimal =
      at >= 2 && is_digit(text[at]) && text[at - 1] == ',' && is_digit(text[at - 2]);
  if (!is_decimal) return "";
  return "a number has a decimal point, not a comma: write " +
         word_at(text, word_start(text, at - 2)) + "." + word_at(text, at);
}

constexpr const char* unit_message =
    "a number has no unit here: see \"units\" in the manual of sweeps";

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }

/// Whether the byte at `at` is the line of a fraction, as in 1/2.
bool is_fraction(std::string_view text, std::size_t at) {
  return text[at] == '/' && at > 0 && is_digit(text[at - 1]) && at + 1 < text.size() &&
         is_digit(text[at + 1]);
}

/// Signs and words that people and word processors write, and what JSON wants; "" for others.
std::string habit_message(std::string_view text, std::size_t at, const std::string& complaint) {
  const std::string_view rest = text.substr(at);
  for (const char* const curly :
       {"\u201c", "\u201d", "\u201e", "\u2018", "\u2019", "\u00ab", "\u00bb"}) {
    if (rest.starts_with(curly)) return "a text needs straight double quotes: \"";
  }
  if (has(complaint, "forbidden character after backslash")) {
    return "a backslash is written as two; names of files may have / in its place";
  }
  if (rest.starts_with('%')) return "JSON has no %: write 5 % as 0.05";
  if (rest.starts_with(';')) return "write a comma in place of ;";
  if (is_fraction(text, at)) return "JSON has no fractions: write 1/2 as 0.5";
  if (is_digit(text[at]) && is_letter(word_at(text, at).back())) return unit_message;
  if (is_letter(text[at])) {
    return "names and texts need double quotes: \"" + shortened(word_at(text, at)) + "\"";
  }
  return "";
}

/// Whether every bracket before `at` is closed, and one is there.
bool is_behind_the_end(std::string_view text, std::size_t at) {
  if (last_before(text, at) != '}') return false;
  int depth = 0;
  bool is_quoted = false;
  for (std::size_t i = 0; i < at; ++i) {
    if (text[i] == '"') is_quoted = !is_quoted;
    if (is_quoted && text[i] == '\\') ++i;
    if (is_quoted) continue;
    if (text[i] == '{' || text[i] == '[') ++depth;
    if (text[i] == '}' || text[i] == ']') --depth;
  }
  return depth == 0 && !is_quoted;
}

/// The token that ends before `end`, for a message.
std::string token_before(std::string_view text, std::size_t end) {
  const char last = text[end - 1];
  std::size_t start = word_start(text, end - 1);
  if (last == '"' && end >= 2) start = text.rfind('"', end - 2);
  return shortened(text.substr(start, end - start));
}

std::string message_at(const std::string& text, std::size_t at, const std::string& complaint) {
  const char c = at < text.size() ? text[at] : '\0';
  if (has(complaint, "ill-formed UTF-8")) return "is not UTF-8 text here; save the file as UTF-8";
  if (has(complaint, "number overflow")) return "this number is too large for a 64-bit float";
  if (at >= text.size()) return "the file ends too early: a bracket or a quote is not closed";
  if (is_word(c) && last_before(text, at) == '\0') return "is not JSON, which begins with '{'";
  if (is_nan_or_infinity(std::string_view(text).substr(at))) {
    return "JSON has no NaN and no Infinity; write a finite number";
  }
  if (c == '\'') return "a string needs double quotes";
  if (c == '#' || (c == '/' && !is_fraction(text, at))) return "JSON has no comments; remove it";
  if (is_behind_the_end(text, at)) return "the sweep has ended before this; remove it";
  if ((c == '}' || c == ']') && last_before(text, at) == ',') {
    return std::string("remove the comma before this '") + c + "'";
  }
  if (std::string message = decimal_comma_message(text, at); !message.empty()) return message;
  if (std::string message = number_message(text, at); !message.empty()) return message;
  if (std::string message = habit_message(text, at, complaint); !message.empty()) return message;
  return "malformed JSON: " + plain(complaint);
}

/// Whether a value or a key stands where a comma or a closing bracket should.
bool lacks_comma(std::string_view text, std::size_t at, const std::string& complaint) {
  const bool wants_end = has(complaint, "expected '}'") || has(complaint, "expected ']'");
  return wants_end && (is_number_or_word(text[at]) || has("\"[{", text.substr(at, 1)));
}

}  // namespace

SyntaxError syntax_error(const std::string& text, const SyntaxStop& stop,
                         const std::string& complaint) {
  // A number that breaks off is noticed at the character after it.
  const bool breaks_off = has(complaint, "invalid number") && stop.at > 0;
  const std::size_t last = breaks_off && !ends_number(text, stop.at + 1) ? stop.at - 1 : stop.at;
  const std::size_t at = word_start(text, last);
  const bool is_understood = at < text.size() && at >= stop.token_end;
  if (is_understood && stop.token_end > 0 && lacks_comma(text, at, complaint)) {
    if (is_digit(text[stop.token_end - 1]) && is_letter(text[at])) return {at, unit_message};
    return {stop.token_end, "a comma is missing after " + token_before(text, stop.token_end)};
  }
  return {at, message_at(text, at, complaint)};
}

bool ends_number(const std::string& text, std::size_t end) {
  return end > 0 && is_number_or_word(text[end - 1]);
}

}  // namespace grainsweep
