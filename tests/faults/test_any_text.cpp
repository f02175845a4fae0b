// A hundred thousand damaged sweep files, the same ones on every machine; fuzz.sh tries more.
#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "runner/machine.hpp"
#include "runner/store/files.hpp"
#include "tests/faults/any_text.hpp"
#include "tests/support/draw.hpp"
#include "tests/support/tries.hpp"

namespace grainsweep {
namespace {

using testing::Draw;

std::vector<std::string> whole_sweeps() {
  std::vector<std::string> sweeps = {read_file(GRAINSWEEP_FAULTS_FOLDER "/kinds.json")};
  for (const char* name : {"quick", "confined-spheres", "paper-spheres", "paper-pinacoids"}) {
    sweeps.push_back(read_file(GRAINSWEEP_CONFIGS "/" + std::string(name) + ".json"));
  }
  return sweeps;
}

/// In the place of a value or a key the text stays JSON, and the damage reaches beyond the parser.
constexpr std::array values = {"3",
                               "0.5",
                               "-1",
                               "1e308",
                               "1e-400",
                               "-0",
                               "null",
                               "true",
                               "[]",
                               "{}",
                               "[3, 4]",
                               "\"\"",
                               "\"fast\"",
                               "\"exact\"",
                               "\"walls\"",
                               "\"grid\"",
                               "\"zip\"",
                               "\"set\"",
                               "\"seed\"",
                               "\"random\"",
                               "\"count\"",
                               "\"file\"",
                               "\"shape\"",
                               "\"pinacoid\"",
                               "\"vertices\"",
                               "[[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]",
                               "\"fill\"",
                               "\"choice\"",
                               "\"uniform\"",
                               "\"replicates\"",
                               "\"box.width\"",
                               "\"\\u0000\"",
                               "\"\\ud800\"",
                               "18446744073709551615"};

constexpr std::array pieces = {"[",  "]", "{",    "}",    ",",    ":",
                               "\"", "-", "[[[[", "\xff", "\xc3", "\n"};

struct Range {
  std::size_t begin, size;
};

Range any_range(const std::string& text, Draw& draw) {
  const std::size_t begin = draw.below(text.size() + 1);
  return {begin, draw.below(std::min<std::size_t>(text.size() - begin, 40) + 1)};
}

void flip_a_bit(std::string& text, Draw& draw) {
  if (text.empty()) return;
  const std::size_t at = draw.below(text.size());
  text[at] = static_cast<char>(text[at] ^ (1 << draw.below(8)));
}

/// Puts `piece` in the place of a short stretch of the text.
void replace_a_range(std::string& text, const std::string& piece, Draw& draw) {
  const Range range = any_range(text, draw);
  text.replace(range.begin, range.size, piece);
}

std::string piece_of(const std::string& text, Draw& draw) {
  const Range range = any_range(text, draw);
  return text.substr(range.begin, range.size);
}

bool is_of_a_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '.';
}

/// The string, number or name that begins at or after `from`; empty at the end if there is none.
Range next_value(const std::string& text, std::size_t from) {
  const auto begins = [](char c) { return c == '"' || is_of_a_word(c); };
  const auto at = [&](std::size_t i) { return text.begin() + static_cast<std::ptrdiff_t>(i); };
  const auto begin = std::find_if(at(from), text.end(), begins);
  if (begin == text.end()) return {text.size(), 0};
  auto end = *begin == '"' ? std::find(begin + 1, text.end(), '"')
                           : std::find_if_not(begin, text.end(), is_of_a_word);
  if (*begin == '"' && end != text.end()) ++end;
  return {static_cast<std::size_t>(begin - text.begin()), static_cast<std::size_t>(end - begin)};
}

Range any_value(const std::string& text, Draw& draw) {
  // From a line's start: in the middle of a string its end would be taken for a beginning.
  const std::size_t line = text.rfind('\n', draw.below(text.size() + 1));
  Range value = next_value(text, line == std::string::npos ? 0 : line);
  for (std::size_t skip = draw.below(20); skip > 0; --skip) {
    value = next_value(text, value.begin + value.size);
  }
  return value;
}

void replace_a_value(std::string& text, const std::string& by, Draw& draw) {
  const Range value = any_value(text, draw);
  text.replace(value.begin, value.size, by);
}

std::string value_of(const std::string& text, Draw& draw) {
  const Range value = any_value(text, draw);
  return text.substr(value.begin, value.size);
}

void damage_once(std::string& text, const std::vector<std::string>& sweeps, Draw& draw) {
  const std::string& other = sweeps[draw.below(sweeps.size())];
  switch (draw.below(8)) {
    case 0:
      return flip_a_bit(text, draw);
    case 1:
      return replace_a_range(text, "", draw);
    case 2:
      return replace_a_range(text, piece_of(other, draw), draw);
    case 3:
      return replace_a_range(text, pieces[draw.below(pieces.size())], draw);
    case 4:
    case 5:
      return replace_a_value(text, value_of(other, draw), draw);
    default:
      return replace_a_value(text, values[draw.below(values.size())], draw);
  }
}

std::string damaged(const std::vector<std::string>& sweeps, Draw& draw) {
  std::string text = sweeps[draw.below(sweeps.size())];
  const std::size_t times = 1 + draw.below(2);
  for (std::size_t time = 0; time < times; ++time) damage_once(text, sweeps, draw);
  return text;
}

struct Tally {
  int unsound = 0, json = 0, sweeps = 0;
  double slowest = 0.0;  ///< s of CPU
  std::string example;   ///< of an unsound one

  void add(const std::string& text) {
    const double began = thread_cpu_seconds();
    const testing::Reading reading = testing::read_any_text(text);
    slowest = std::max(slowest, thread_cpu_seconds() - began);
    json += reading.is_json ? 1 : 0;
    sweeps += reading.is_sweep ? 1 : 0;
    unsound += reading.is_sound ? 0 : 1;
    if (!reading.is_sound) example = text;
  }
};

TEST_CASE("the sweep files that are damaged are whole") {
  Tally tally;
  for (const std::string& whole : whole_sweeps()) tally.add(whole);
  CHECK(tally.json == 5);
  CHECK(tally.sweeps == 4);  // all but the one with a missing file
  CHECK(tally.unsound == 0);
}

TEST_CASE("a damaged sweep file is read or refused, and never for longer than a second") {
  const std::vector<std::string> sweeps = whole_sweeps();
  constexpr int tries = testing::is_sanitized ? 5'000 : 100'000;
  Draw draw(20130708);
  Tally tally;
  for (int number = 0; number < tries; ++number) tally.add(damaged(sweeps, draw));
  CAPTURE(tally.example);
  CHECK(tally.unsound == 0);
  CHECK(tally.slowest < 1.0);
  // The damage reaches the JSON parser, the rules of sweeps and the jobs: each refuses some.
  CHECK(tally.json < tries * 9 / 10);
  CHECK(tally.sweeps < tally.json * 9 / 10);
  CHECK(tally.sweeps > tries / 100);
}

}  // namespace
}  // namespace grainsweep
