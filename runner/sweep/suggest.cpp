#include "runner/sweep/suggest.hpp"

#include <algorithm>

#include "runner/sweep/text_lines.hpp"

namespace grainsweep {

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, replaced});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before.swap(last);
    last.swap(row);
  }
  return last[b.size()];
}

namespace {

/// The only candidate that begins with `word`, of at least three letters: "error" of "err"; "" if
/// there is none, or more than one.
std::string whole_word(std::string_view word, const std::vector<std::string>& candidates) {
  constexpr std::size_t shortest = 3;
  std::string found;
  for (const std::string& candidate : candidates) {
    if (word.size() < shortest || !candidate.starts_with(word)) continue;
    if (!found.empty()) return "";
    found = candidate;
  }
  return found;
}

}  // namespace

std::string nearest(std::string_view word, const std::vector<std::string>& candidates) {
  constexpr std::size_t longest_word = 100;  // longer ones are not misspelt
  if (word.size() > longest_word) return "";
  std::size_t best = std::max<std::size_t>(1, word.size() / 3) + 1;
  std::string found;
  for (const std::string& candidate : candidates) {
    const std::size_t distance = edit_distance(word, candidate);
    if (distance >= best) continue;
    best = distance;
    found = candidate;
  }
  return found.empty() ? whole_word(word, candidates) : found;
}

std::string shortened(std::string_view text) {
  constexpr std::size_t longest_shown = 60;
  if (text.size() <= longest_shown) return std::string(text);
  std::size_t end = longest_shown;
  while (end > 0 && !begins_character(text[end])) --end;
  return std::string(text.substr(0, end)) + "...";
}

std::string comma_list(const std::vector<std::string>& words) {
  std::string list;
  for (const std::string& word : words) list.append(list.empty() ? "" : ", ").append(word);
  return list;
}

std::string short_list(const std::vector<std::string>& words) {
  std::vector<std::string> short_ones;
  for (const std::string& word : words) {
    if (word.find('.') == std::string::npos) short_ones.push_back(word);
  }
  return comma_list(short_ones);
}

std::string unknown_key(std::string_view key, const std::vector<std::string>& known) {
  const std::string near = nearest(key, known);
  const std::string start = "unknown key \"" + shortened(key) + "\"; ";
  if (near.empty()) return start + "known here: " + short_list(known);
  return start + "did you mean \"" + near + "\"?";
}

void refuse_unknown_keys(const Json& object, const std::string& pointer,
                         const std::vector<std::string>& known, Diagnostics& diagnostics) {
  for (const auto& [key, value] : object.items()) {
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    diagnostics.push_back({child_pointer(pointer, key), unknown_key(key, known), Anchor::key});
  }
}

}  // namespace grainsweep
