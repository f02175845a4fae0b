#include "runner/sweep/diagnostic.hpp"

#include <algorithm>

#include "runner/sweep/text_lines.hpp"

namespace grainsweep {

bool has_errors(const Diagnostics& diagnostics) {
  return !std::all_of(diagnostics.begin(), diagnostics.end(),
                      [](const Diagnostic& diagnostic) { return diagnostic.is_note; });
}

std::string to_string(const Diagnostic& diagnostic) {
  const std::string pointer = diagnostic.pointer.empty() ? "" : " " + diagnostic.pointer;
  return without_controls(diagnostic.place + pointer + ": " + diagnostic.message);
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

}  // namespace grainsweep
