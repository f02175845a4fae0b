// The command `manual`: what an installation has besides the program.
#include <iostream>

#include <CLI/App.hpp>

#include "runner/commands/command_line.hpp"
#include "runner/commands/commands.hpp"
#include "runner/commands/manual_texts.hpp"
#include "runner/exit_codes.hpp"
#include "runner/store/files.hpp"

namespace grainsweep {

void add_command(CLI::App& app, ManualOptions& options) {
  CLI::App& manual = *app.add_subcommand(
      "manual", "Write manual pages of all commands and completions for bash, zsh and fish");
  manual.add_option("DIR", options.folder, "folder to write them into")->required()->type_name("");
  manual.footer(
      "Writes man1/*.1, grainsweep.bash, _grainsweep (zsh) and grainsweep.fish.\n\n"
      "Example: grainsweep manual manual");
}

int perform(const ManualOptions& options) {
  CLI::App app;
  AllOptions all;
  describe(app, all);
  make_folder(options.folder + "/man1");
  for (const auto& [name, text] : manual_pages(app)) {
    replace_file(options.folder + "/man1/" + name, text);
  }
  replace_file(options.folder + "/grainsweep.bash", bash_completion(app));
  replace_file(options.folder + "/_grainsweep", zsh_completion(app));
  replace_file(options.folder + "/grainsweep.fish", fish_completion(app));
  std::cout << "Written into " << options.folder << "\n";
  return exit_done;
}

}  // namespace grainsweep
