#include "runner/commands/shared_options.hpp"

#include <CLI/App.hpp>

namespace grainsweep {

void add_threads(CLI::App& command, int& threads) {
  command.add_option("--threads", threads, "packings at once (default: one per core)")
      ->check(CLI::Range(1, 1024))
      ->type_name("N");
}

void add_file(CLI::App& command, std::string& file) {
  command.add_option("FILE", file, "sweep definition, JSON")->required()->type_name("");
}

void add_folder(CLI::App& command, std::string& folder) {
  command.add_option("DIR", folder, "output folder of a run")->required()->type_name("");
}

}  // namespace grainsweep
