#include "runner/sweep/read_sweep.hpp"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "runner/sweep/expand.hpp"
#include "runner/sweep/json_text.hpp"
#include "runner/sweep/sweep_definition.hpp"
#include "runner/sweep/text_lines.hpp"

namespace grainsweep {

SweepReading read_sweep(const std::string& path) {
  FileText file = read_text(path);
  if (!file.errors.empty()) return {{}, std::move(file.errors), {}};
  JsonReading json = parse_strictly(file.text, path);
  if (!json.errors.empty()) return {{}, std::move(json.errors), {}};

  Diagnostics diagnostics;
  const SweepDefinition definition = read_definition(json.value, diagnostics);
  const std::string folder = std::filesystem::path(path).parent_path().string();
  std::vector<Job> jobs = expand(definition, folder, diagnostics);

  locate(json, file.text, path, diagnostics);
  const auto is_note = [](const Diagnostic& diagnostic) { return diagnostic.is_note; };
  if (!std::all_of(diagnostics.begin(), diagnostics.end(), is_note)) {
    std::erase_if(diagnostics, is_note);
    return {{}, std::move(diagnostics), {}};
  }
  Sweep sweep{definition.name, definition.seed, definition.replicates, std::move(jobs),
              definition.units};
  return {std::move(sweep), {}, std::move(diagnostics)};
}

}  // namespace grainsweep
