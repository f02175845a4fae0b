#include "runner/commands/command_line.hpp"

#include <string>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "runner/commands/shared_options.hpp"
#include "runner/exit_codes.hpp"
#include "runner/versions.hpp"

namespace grainsweep {

CommandLine read_command_line(int argc, const char* const* argv) {
  CLI::App app{
      "grainsweep " + program_version() +
          ": packs beds of rigid frictionless grains as a JSON sweep file says, and measures how\n"
          "walls change solid fraction and coordination number.",
      "grainsweep"};
  app.set_version_flag("--version", "grainsweep " + program_version());
  app.require_subcommand(1);
  app.get_formatter()->column_width(24);
  app.footer(std::string("Example: grainsweep run configs/quick.json --out out/quick\n"
                         "Help on a command: grainsweep run --help\n\n") +
             exit_codes_text);
  CommandLine line;
  AllOptions all;
  const auto add = [&](auto& options) {
    add_command(app, options).callback([&] { line.command = options; });
  };
  std::apply([&](auto&... options) { (add(options), ...); }, all);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return {std::nullopt, app.exit(error) == 0 ? exit_done : exit_bad_input};
  }
  return line;
}

}  // namespace grainsweep
