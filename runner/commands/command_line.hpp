// The command line: what was asked for, or why it cannot be done.
#pragma once

#include <optional>
#include <tuple>
#include <variant>

#include "runner/commands/commands.hpp"

namespace grainsweep {

/// The options of all commands, in the order in which help lists them.
using AllOptions =
    std::tuple<RunOptions, InitOptions, ValidateOptions, PlanOptions, SlurmOptions, ReportOptions,
               CompareOptions, ExportOptions, StatusOptions, CollectOptions, SchemaOptions,
               ColumnsOptions, ManualOptions, DoctorOptions>;

template <class Options>
struct OneOf;
template <class... Options>
struct OneOf<std::tuple<Options...>> {
  using Type = std::variant<Options...>;
};

/// A command, known by its options.
using Command = OneOf<AllOptions>::Type;

struct CommandLine {
  std::optional<Command> command;  ///< nothing after --help, --version or a mistake
  int exit_code = 0;               ///< to return without a command; everything has been printed
};

/// Describes the program and all its commands to `app`; their options are stored in `all`.
void describe(CLI::App& app, AllOptions& all);

CommandLine read_command_line(int argc, const char* const* argv);

}  // namespace grainsweep
