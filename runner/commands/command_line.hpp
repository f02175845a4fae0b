// The command line: what was asked for, or why it cannot be done.
#pragma once

#include <optional>
#include <variant>

#include "runner/commands/commands.hpp"

namespace grainsweep {

using Command = std::variant<RunOptions, ValidateOptions, PlanOptions, ReportOptions, ExportOptions,
                             StatusOptions, CompareOptions, CollectOptions, ColumnsOptions,
                             SchemaOptions, DoctorOptions>;

struct CommandLine {
  std::optional<Command> command;  ///< nothing after --help, --version or a mistake
  int exit_code = 0;               ///< then to be returned; everything has been printed
};

CommandLine read_command_line(int argc, const char* const* argv);

}  // namespace grainsweep
