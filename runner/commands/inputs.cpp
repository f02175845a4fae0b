#include "runner/commands/inputs.hpp"

#include <algorithm>
#include <iostream>
#include <stdexcept>
#include <utility>

#include "runner/compare/reference.hpp"
#include "runner/exit_codes.hpp"
#include "runner/jobs/growing_groups.hpp"
#include "runner/store/files.hpp"
#include "runner/sweep/far_shapes.hpp"
#include "runner/sweep/low_beds.hpp"
#include "runner/sweep/read_sweep.hpp"
#include "runner/sweep/text_lines.hpp"
#include "runner/text.hpp"
#include "runner/versions.hpp"

namespace grainsweep {

namespace {

SweepReading reading_or_refusal(const std::string& file, const SweepCheck& check) {
  SweepReading reading = read_sweep(file, check);
  if (reading.errors.empty()) return reading;
  std::string text;
  for (const Diagnostic& diagnostic : reading.errors) text += to_string(diagnostic) + "\n";
  throw BadInput(text + counted(reading.errors.size(), "error") + "; nothing was run");
}

/// Published values beside a sweep are read once its packings are made, which may take a night.
void note_on_reference(const std::string& file) {
  if (!file_exists(file)) return;
  try {
    read_reference(file);
  } catch (const std::runtime_error& error) {  // of what is in it, or of the file
    std::cerr << "note: the page will have no published values: "
              << lines_without_controls(error.what()) << "\n";
  }
}

}  // namespace

Sweep sweep_or_refusal(const std::string& file) {
  Sweep sweep = std::move(reading_or_refusal(file, unreachable_wishes).sweep);
  note_on_reference(reference_beside(file));
  return sweep;
}

Sweep sweep_with_notes(const std::string& file) {
  const auto check = [](const Sweep& sweep) {
    Diagnostics told = unreachable_wishes(sweep);
    for (Diagnostic& note : notes_on_far_shapes(sweep)) told.push_back(std::move(note));
    for (Diagnostic& note : notes_on_low_beds(sweep)) told.push_back(std::move(note));
    for (Diagnostic& note : notes_on_unbounded_wishes(sweep)) told.push_back(std::move(note));
    return told;
  };
  SweepReading reading = reading_or_refusal(file, check);
  for (const Diagnostic& note : reading.notes) std::cerr << "note: " << to_string(note) << "\n";
  note_on_reference(reference_beside(file));
  return std::move(reading.sweep);
}

std::size_t place_of_job(const std::string& given, const std::vector<std::string>& ids,
                         const std::string& where) {
  const auto is_it = [&](const std::string& id) { return !given.empty() && id.starts_with(given); };
  const auto same = std::find(ids.begin(), ids.end(), given);
  if (same != ids.end()) return static_cast<std::size_t>(same - ids.begin());
  const auto found = std::find_if(ids.begin(), ids.end(), is_it);
  if (found == ids.end()) {
    throw BadInput("--job " + given + ": no such packing; see the column job in " + where);
  }
  const auto other = std::find_if(found + 1, ids.end(), is_it);
  if (other != ids.end()) {
    throw BadInput("--job " + given + ": several packings begin so, " + *found + " and " + *other +
                   "; give more of the id");
  }
  return static_cast<std::size_t>(found - ids.begin());
}

Results results_with_warnings(const std::string& folder, Detail detail) {
  Results results = read_results(folder, detail);
  const bool is_made = std::all_of(results.rows.begin(), results.rows.end(),
                                   [](const Row& row) { return static_cast<bool>(row.outcome); });
  const std::vector<RunRecord>& runs = results.provenance.runs;
  const bool is_ended = !runs.empty() && !runs.back().ended.empty();
  if (!is_made || !is_ended) std::cerr << damage_warnings(results.damage);
  std::cerr << other_versions_warning(results.rows, program_version());
  return results;
}

}  // namespace grainsweep
