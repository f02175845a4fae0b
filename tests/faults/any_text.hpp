// Any text as a sweep file: it is read, or refused with a place and a message; never a crash.
#pragma once

#include <string>

namespace grainsweep::testing {

struct Reading {
  bool is_json = false;   ///< what was read is JSON; if not, it was refused at once
  bool is_sweep = false;  ///< and a sweep without errors
  /// It was read or refused as it should be: every finding on one line, with its place and a
  /// message, and no job that the engine would not take.
  bool is_sound = false;
};

Reading read_any_text(const std::string& text);

}  // namespace grainsweep::testing
