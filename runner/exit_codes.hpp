// How the program ends, for people and scripts.
#pragma once

#include <stdexcept>
#include <string>

namespace grainsweep {

enum ExitCode : int {
  exit_done = 0,         ///< everything asked for is done
  exit_left_out = 1,     ///< done, but some packings failed or did not settle: tables say which
  exit_bad_input = 2,    ///< sweep file, command line or environment; nothing was written
  exit_busy = 3,         ///< another runner works in the output folder
  exit_file_system = 4,  ///< a file could not be read or written
  exit_stopped = 128,  ///< + signal: 129 SIGHUP, 130 Ctrl-C, 143 SIGTERM; the same command goes on
};

/// Input the program refuses; the message says where, what, and how to put it right.
struct BadInput : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace grainsweep
