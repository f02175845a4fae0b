// Completion of the command line by a shell.
#pragma once

#include <string>
#include <vector>

namespace grainsweep {

/// What can be typed after a command.
struct CommandWords {
  std::string command;
  std::vector<std::string> options;  ///< "--out"
};

/// A script for bash that completes commands, options, their values where there are few, and files.
std::string bash_completion(const std::vector<CommandWords>& commands);

}  // namespace grainsweep
