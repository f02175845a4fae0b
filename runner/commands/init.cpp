// The command `init`: a sweep to start from, and the schema with which editors complete it.
#include <iostream>
#include <string_view>

#include <CLI/App.hpp>

#include "runner/commands/commands.hpp"
#include "runner/exit_codes.hpp"
#include "runner/machine.hpp"
#include "runner/store/files.hpp"
#include "runner/sweep/schema.hpp"
#include "runner/sweep/sweep_definition.hpp"
#include "runner/text.hpp"

namespace grainsweep {
namespace {

constexpr const char* schema_file = "sweep.schema.json";
constexpr std::string_view sweep_ending = ".json";

/// One block of each kind that most sweeps need; labels say what each adds.
std::string first_sweep(const std::string& name) {
  return R"({
  "$schema": ")" +
         std::string(schema_file) + R"(",
  "name": ")" +
         name + R"(",
  "seed": 1,
  "replicates": 3,
  "base": {
    "shape": "sphere",
    "box": { "length": 12, "x": "periodic", "y": "walls" },
    "fill": { "solid_height": 9.95 },
    "sizes": { "spread": 0.03 },
    "accuracy": "balanced"
  },
  "sweep": [
    { "label": "walls at four gaps", "grid": { "box.width": [4, 5, 6, 8] } },
    { "label": "two sizes", "set": { "sizes.small_share": 0.25 }, "grid": { "box.width": [4, 6, 8] } },
    { "label": "no walls", "set": { "box.width": 12, "box.y": "periodic" } }
  ]
}
)";
}

}  // namespace

void add_command(CLI::App& app, InitOptions& options) {
  CLI::App& init = *app.add_subcommand(
      "init",
      "Write a sweep file to start from, and beside it the schema that editors complete it by");
  init.add_option("NAME", options.name, "name of the sweep, or of its file, which ends in .json")
      ->capture_default_str()
      ->type_name("");
  init.footer("Example: grainsweep init my-sweep");
}

int perform(const InitOptions& options) {
  std::string name = options.name;
  if (name.ends_with(sweep_ending)) name.resize(name.size() - sweep_ending.size());
  if (!is_sweep_name(name)) {
    throw BadInput(
        "the name of a sweep has 1 to 100 letters, digits, '-', '_' and '.', the first no "
        "'.'; is \"" +
        options.name + "\"");
  }
  const std::string file = name + std::string(sweep_ending);
  if (file == schema_file) throw BadInput(file + " is the name of the schema; take another one");
  if (file_exists(file)) throw BadInput(file + " is there already; take another name");
  replace_file(schema_file, sweep_schema());
  replace_file(file, first_sweep(name));
  std::cout << "Written: " << file << ", and " << schema_file << " for completion in editors.\n"
            << "Next: " << called_as() << " plan " << shell_path(file) << "\n";
  return exit_done;
}

}  // namespace grainsweep
