#include "runner/sweep/diagnostic.hpp"

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

}  // namespace

std::string to_string(const Diagnostic& diagnostic) {
  const std::string pointer = diagnostic.pointer.empty() ? "" : " " + diagnostic.pointer;
  return printable(diagnostic.place + pointer + ": " + diagnostic.message);
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
