// How the program ends, for people and scripts.
#pragma once

#include <stdexcept>

namespace grainsweep {

enum ExitCode : int {
  exit_done = 0,          ///< everything asked for is done
  exit_left_out = 1,      ///< done, but some packings failed or did not settle: tables say which
  exit_bad_input = 2,     ///< sweep file, command line or environment; nothing was written
  exit_busy = 3,          ///< another runner works in the output folder
  exit_file_system = 4,   ///< a file could not be read or written
  exit_no_resources = 5,  ///< the system gives too little memory or too few threads
  exit_out_of_time = 6,   ///< the limit of time came before the end; the same command goes on
  exit_unforeseen = 7,    ///< an error that the program did not foresee; not all was done
  exit_stopped = 128,     ///< + signal: 130 Ctrl-C, 143 SIGTERM, 129 SIGHUP, 138 SIGUSR1; the same
                          ///< command goes on
};

/// The system gives less memory or fewer threads than are needed; the message says what to do.
struct NoResources : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Input the program refuses; the message says where, what, and how to put it right.
struct BadInput : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace grainsweep
