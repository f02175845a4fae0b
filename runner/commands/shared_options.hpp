// Arguments that several commands take, and what several of them say in their help.
#pragma once

#include <string>
#include <vector>

namespace CLI {  // NOLINT(readability-identifier-naming): as CLI11 calls it
class App;
class Option;
class Validator;
}  // namespace CLI

namespace grainsweep {

inline constexpr const char* exit_codes_text =
    "Exit codes: 0 done; 1 done, but some packings failed or did not settle; 2 bad\n"
    "input, nothing written; 3 another runner works in the folder; 4 file system; 5\n"
    "too little memory or too few threads; 6 out of time; 7 an unforeseen error; 129,\n"
    "130, 138, 143 or 152 stopped by SIGHUP, Ctrl-C, SIGUSR1, SIGTERM or a limit of\n"
    "CPU time. After 6 and a signal the same command goes on where it stopped.";

/// A sweep file.
void add_file(CLI::App& command, std::string& file);

/// The output folder of a run.
void add_folder(CLI::App& command, std::string& folder);

/// For the name of a folder, which may be left out but not be empty, as an unset variable makes it.
CLI::Validator not_empty();

/// Packings by their ids, or how these begin: of several options, and with commas in one.
CLI::Option* add_jobs(CLI::App& command, std::vector<std::string>& jobs,
                      const std::string& meaning);

/// How many packings are made at once; stays 0 if it is not given.
void add_threads(CLI::App& command, int& threads);

/// What share of packings, 0..1, may be unsettled without counting in the exit code; `share` is
/// unchanged if the option is not given, and 1 if it is given without a share.
void add_tolerance(CLI::App& command, double& share, const std::string& meaning);

/// Accepts only numbers in [least, most]; CLI::Range lets nan pass, which lies in no range.
CLI::Validator number_within(double least, double most);

}  // namespace grainsweep
