#include "runner/commands/inputs.hpp"

#include <iostream>
#include <utility>

#include "runner/exit_codes.hpp"
#include "runner/sweep/read_sweep.hpp"
#include "runner/versions.hpp"

namespace grainsweep {

Sweep sweep_or_refusal(const std::string& file) {
  SweepReading reading = read_sweep(file);
  if (reading.errors.empty()) return std::move(reading.sweep);
  std::string text;
  for (const Diagnostic& diagnostic : reading.errors) text += to_string(diagnostic) + "\n";
  const std::size_t count = reading.errors.size();
  throw BadInput(text + std::to_string(count) + (count == 1 ? " error" : " errors") +
                 "; nothing was run");
}

Results results_with_warnings(const std::string& folder, Detail detail) {
  Results results = read_results(folder, detail);
  std::cerr << damage_warnings(results.damage);
  std::cerr << other_versions_warning(results.rows, program_version());
  return results;
}

}  // namespace grainsweep
