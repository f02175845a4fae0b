// The command `schema`: what a sweep file may hold, for editors.
#include "runner/sweep/schema.hpp"

#include <iostream>

#include <CLI/App.hpp>

#include "runner/commands/commands.hpp"
#include "runner/exit_codes.hpp"
#include "runner/sweep/parameter_table.hpp"

namespace grainsweep {

void add_command(CLI::App& app, SchemaOptions& options) {
  CLI::App& schema =
      *app.add_subcommand("schema", "Print the JSON Schema of sweep files, for editors");
  schema.add_flag("--markdown", options.markdown,
                  "the table of parameters instead: type, range, default, meaning");
  schema.footer("Example: grainsweep schema >sweep.schema.json");
}

int perform(const SchemaOptions& options) {
  std::cout << (options.markdown ? parameter_table() : sweep_schema());
  return exit_done;
}

}  // namespace grainsweep
