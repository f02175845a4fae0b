#include "runner/sweep/problem.hpp"

#include <algorithm>
#include <set>
#include <unordered_map>
#include <utility>

#include "runner/sweep/json_places.hpp"

namespace grainsweep {
namespace {

/// Without control characters, which a key may hold and a terminal would obey.
std::string printable(std::string text) {
  for (char& c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7F) c = '?';
  }
  return text;
}

struct Offsets {
  std::size_t key = 0, value = 0;
  bool found = false;
};
using Wanted = std::unordered_map<std::string, Offsets>;

std::string parent_of(const std::string& pointer) { return pointer.substr(0, pointer.rfind('/')); }

Wanted wanted_pointers(const Problems& problems) {
  Wanted wanted;
  wanted[""];
  for (const Problem& problem : problems) {
    std::string pointer = problem.pointer;
    while (wanted.emplace(pointer, Offsets{}).second) pointer = parent_of(pointer);
  }
  return wanted;
}

void look_up(const std::string& text, Wanted& wanted) {
  for_each_value(text, [&](const JsonPlace& place) {
    const auto entry = wanted.find(place.pointer);
    if (entry == wanted.end() || entry->second.found) return;
    entry->second = {place.key, place.value, true};
  });
}

std::size_t offset_of(const Problem& problem, const Wanted& wanted) {
  std::string pointer = problem.pointer;
  while (!wanted.at(pointer).found && !pointer.empty()) pointer = parent_of(pointer);
  const Offsets& offsets = wanted.at(pointer);
  return problem.anchor == Anchor::key ? offsets.key : offsets.value;
}

}  // namespace

std::string to_string(const Finding& finding) {
  const std::string pointer = finding.pointer.empty() ? "" : " " + finding.pointer;
  return printable(finding.place + pointer + ": " + finding.message);
}

std::string child_pointer(const std::string& pointer, std::string_view key) {
  std::string child = pointer + "/";
  for (const char c : key) {
    if (c == '~') child += "~0";
    if (c == '/') child += "~1";
    if (c != '~' && c != '/') child += c;
  }
  return child;
}

std::vector<Finding> findings_of(const Problems& problems, const std::string& text,
                                 const std::string& file) {
  if (problems.empty()) return {};
  Wanted wanted = wanted_pointers(problems);
  look_up(text, wanted);
  std::vector<std::pair<std::size_t, const Problem*>> order;
  for (const Problem& problem : problems) order.emplace_back(offset_of(problem, wanted), &problem);
  std::stable_sort(order.begin(), order.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });

  const LineIndex lines(text);
  std::vector<Finding> findings;
  std::set<std::pair<std::string, std::string>> said;
  for (const auto& [offset, problem] : order) {
    const bool here = problem->elsewhere.empty();
    Finding finding{here ? file + lines.place(offset) : problem->elsewhere,
                    here ? problem->pointer : "", problem->message};
    if (said.emplace(finding.place + finding.pointer, finding.message).second) {
      findings.push_back(std::move(finding));
    }
  }
  return findings;
}

}  // namespace grainsweep
