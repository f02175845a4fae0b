#include "runner/sweep/read_sweep.hpp"

#include <filesystem>
#include <utility>

#include "runner/sweep/blocks.hpp"
#include "runner/sweep/expand.hpp"
#include "runner/sweep/json_text.hpp"

namespace grainsweep {

SweepReading read_sweep(const std::string& path) {
  FileText file = read_text(path);
  if (!file.errors.empty()) return {{}, std::move(file.errors)};
  JsonReading json = parse_strictly(file.text, path);
  if (!json.errors.empty()) return {{}, std::move(json.errors)};

  Problems problems;
  const Blocks blocks = read_blocks(json.value, problems);
  const std::string folder = std::filesystem::path(path).parent_path().string();
  std::vector<Job> jobs = expand(blocks, folder, problems);

  if (!problems.empty()) return {{}, findings_of(problems, file.text, path)};
  return {{blocks.name, blocks.seed, blocks.replicates, std::move(jobs)}, {}};
}

}  // namespace grainsweep
