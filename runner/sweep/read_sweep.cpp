#include "runner/sweep/read_sweep.hpp"

#include <filesystem>
#include <utility>

#include "runner/sweep/expand.hpp"
#include "runner/sweep/json_text.hpp"
#include "runner/sweep/sweep_definition.hpp"
#include "runner/sweep/text_lines.hpp"

namespace grainsweep {

SweepReading read_sweep(const std::string& path, const SweepCheck& check) {
  FileText file = read_text(path);
  if (!file.errors.empty()) return {{}, std::move(file.errors), {}};
  JsonReading json = parse_strictly(file.text, path);
  if (!json.errors.empty()) return {{}, std::move(json.errors), {}};

  Diagnostics diagnostics;
  const SweepDefinition definition = read_definition(json.value, diagnostics);
  const std::string folder = std::filesystem::path(path).parent_path().string();
  Sweep sweep{definition.name, definition.seed, definition.replicates.most,
              expand(definition, folder, diagnostics), definition.units};
  for (const Block& block : definition.blocks) {
    sweep.block_pointers.push_back(block.pointer);
    sweep.wish_pointers.push_back(block.replicates.wish_pointer);
  }
  if (check && !has_errors(diagnostics)) {
    for (Diagnostic& told : check(sweep)) diagnostics.push_back(std::move(told));
  }

  const bool is_refused = has_errors(diagnostics);
  locate(json, file.text, path, diagnostics);
  if (!is_refused) return {std::move(sweep), {}, std::move(diagnostics)};
  std::erase_if(diagnostics, [](const Diagnostic& diagnostic) { return diagnostic.is_note; });
  return {{}, std::move(diagnostics), {}};
}

}  // namespace grainsweep
