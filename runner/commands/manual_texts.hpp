// The command line as manual pages and as completions of shells, made of the commands' own help.
#pragma once

#include <map>
#include <string>

#include <CLI/App.hpp>

namespace grainsweep {

/// Name of the file -> its text: grainsweep.1 and, for each command, grainsweep-<command>.1, in the
/// macros of man(7).
std::map<std::string, std::string> manual_pages(const CLI::App& app);

/// Scripts that complete commands and options in bash, zsh and fish; files where no option is asked
/// for.
std::string bash_completion(const CLI::App& app);
std::string zsh_completion(const CLI::App& app);
std::string fish_completion(const CLI::App& app);

}  // namespace grainsweep
