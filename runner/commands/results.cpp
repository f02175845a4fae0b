#include "runner/commands/results.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <utility>

#include <nlohmann/json.hpp>

#include "runner/exit_codes.hpp"
#include "runner/store/brief.hpp"
#include "runner/store/checkpoints.hpp"
#include "runner/store/files.hpp"
#include "runner/store/states.hpp"
#include "runner/tables/decays.hpp"
#include "runner/tables/distributions.hpp"
#include "runner/tables/fits.hpp"
#include "runner/tables/groups.hpp"
#include "runner/tables/outline.hpp"
#include "runner/tables/packings.hpp"
#include "runner/tables/profiles.hpp"

namespace grainsweep {
namespace {

constexpr std::array tables = {"packings.csv",      "groups.csv",     "fits.csv",
                               "fit_points.csv",    "profiles.csv",   "decays.csv",
                               "distributions.csv", "provenance.json"};

std::string provenance_path(const std::string& folder) { return folder + "/provenance.json"; }

/// provenance.json, as `read` makes it of the text. Throws BadInput.
template <class Read>
auto read_provenance_by(const std::string& folder, Read read) {
  const std::string path = provenance_path(folder);
  if (!file_exists(path)) {
    throw BadInput(folder +
                   ": no output folder of grainsweep (it has no provenance.json); make one with "
                   "grainsweep run FILE --out " +
                   folder);
  }
  try {
    return read(read_file(path));
  } catch (const nlohmann::json::exception& error) {
    throw BadInput(path + ": not what grainsweep wrote (" + error.what() +
                   "); run the sweep again to write it anew, stored packings are kept");
  }
}

Provenance read_provenance(const std::string& folder) {
  return read_provenance_by(folder, provenance_from_text);
}

std::size_t count_foreign(const SweepFacts& sweep, const std::map<std::string, Outcome>& stored) {
  std::set<std::string> ids;
  for (const JobFacts& job : sweep.jobs) ids.insert(job.id);
  const auto is_foreign = [&](const auto& entry) { return !ids.contains(entry.first); };
  return static_cast<std::size_t>(std::count_if(stored.begin(), stored.end(), is_foreign));
}

constexpr const char* no_curves = "missing, damaged or of another version";

/// "states/<job>.grains: missing, ...", for warnings that put the folder before it.
std::string without_curves(const std::string& job) {
  return state_path("", job).substr(1) + ": " + no_curves + "; left out, its packing is made again";
}

/// The group with the curves of its packings, which its rows lacked. Throws FileError.
Group with_curves(const std::string& folder, Group group) {
  for (std::size_t i = 0; i < group.settled.size(); ++i) {
    auto curves = read_curves(folder, group.jobs[i]);
    if (!curves) {
      throw FileError(state_path(folder, group.jobs[i]),
                      std::string(no_curves) + "; run the sweep again to make it anew");
    }
    set_curves(std::move(*curves), group.settled[i]);
  }
  return group;
}

/// The texts of the tables that are made of curves.
struct CurveTables {
  std::string profiles = profiles_header();
  std::string decays = decays_header();
  std::string distributions = distributions_header();
};

/// Holds the curves of one group at a time.
CurveTables curve_tables(const std::string& folder, const std::vector<Group>& groups) {
  CurveTables texts;
  for (std::size_t k = 0; k < groups.size(); ++k) {
    const Group group = with_curves(folder, groups[k]);
    texts.profiles += profile_lines(group, k + 1);
    texts.decays += decay_lines(group, k + 1);
    texts.distributions += distribution_lines(group, k + 1);
  }
  return texts;
}

}  // namespace

Results read_results(const std::string& folder) {
  Results results;
  results.provenance = read_provenance(folder);
  JournalReading journals = read_journals(folder);
  results.rows = join(results.provenance.sweep, journals.outcomes);
  results.damage = std::move(journals.damage);
  results.foreign = count_foreign(results.provenance.sweep, journals.outcomes);
  return results;
}

Overview read_overview(const std::string& folder, const std::string& version) {
  const Outline outline = read_provenance_by(folder, outline_from_text);
  BriefReading stored = read_briefs(folder, version);
  Overview overview;
  overview.name = outline.name;
  overview.sweep_file = outline.sweep_file;
  overview.packings = outline.jobs.size();
  std::size_t finished = 0;
  for (const std::string& job : outline.jobs) {
    const auto found = stored.briefs.find(job);
    count(found == stored.briefs.end() ? std::nullopt : std::optional(found->second.status),
          overview.counts);
    if (found == stored.briefs.end()) continue;
    ++finished;
    overview.cpu_seconds += found->second.cpu_seconds;
    overview.other_versions += found->second.version == version ? 0 : 1;
  }
  overview.damage = std::move(stored.damage);
  overview.foreign = stored.briefs.size() - finished;
  return overview;
}

std::vector<RunRecord> recorded_runs(const std::string& folder) {
  try {
    return read_provenance(folder).runs;
  } catch (const BadInput&) {
    return {};  // a new folder, or a file that is about to be written anew
  }
}

std::vector<std::string> load_curves(const std::string& folder, std::vector<Row>& rows) {
  std::vector<std::string> damage;
  for (Row& row : rows) {
    if (!row.outcome || row.outcome->stored_grains == 0) continue;
    if (auto curves = read_curves(folder, row.job.id)) {
      set_curves(std::move(*curves), row.outcome->result);
    } else {
      damage.push_back(without_curves(row.job.id));
      row.outcome.reset();
    }
  }
  return damage;
}

JournalReading stored_outcomes(const std::string& folder) {
  JournalReading stored = read_journals(folder);
  std::erase_if(stored.outcomes, [&](const auto& entry) {
    const auto& [job, outcome] = entry;
    const bool is_whole = outcome.stored_grains == 0 || read_curves(folder, job);
    if (!is_whole) stored.damage.push_back(without_curves(job));
    return !is_whole;
  });
  return stored;
}

JournalReading finished_outcomes(const std::string& folder) {
  JournalReading stored = stored_outcomes(folder);
  std::erase_if(stored.outcomes, [](const auto& entry) { return entry.second.threw; });
  return stored;
}

void write_tables(const std::string& folder, const Provenance& provenance,
                  const std::vector<Row>& rows) {
  const std::vector<Group> groups = groups_of(rows);
  const std::vector<Family> families = families_of(groups);
  replace_file(folder + "/packings.csv", packings_csv(rows));
  replace_file(folder + "/groups.csv", groups_csv(groups));
  replace_file(folder + "/fits.csv", fits_csv(families));
  replace_file(folder + "/fit_points.csv", fit_points_csv(families));
  const CurveTables curves = curve_tables(folder, groups);
  replace_file(folder + "/profiles.csv", curves.profiles);
  replace_file(folder + "/decays.csv", curves.decays);
  replace_file(folder + "/distributions.csv", curves.distributions);
  write_provenance(folder, provenance, rows);
}

void write_provenance(const std::string& folder, const Provenance& provenance,
                      const std::vector<Row>& rows) {
  replace_file(provenance_path(folder), provenance_text(provenance, rows));
}

std::string damage_warnings(const std::string& folder, const std::vector<std::string>& damage) {
  std::string text;
  for (const std::string& line : damage) text += "warning: " + folder + "/" + line + "\n";
  return text;
}

std::string other_versions_warning(const std::vector<Row>& rows, const std::string& version) {
  const auto is_other = [&](const Row& row) {
    return row.outcome && row.outcome->version != version;
  };
  const auto count = std::count_if(rows.begin(), rows.end(), is_other);
  return other_versions_warning(static_cast<std::size_t>(count), rows.size(), version);
}

std::string other_versions_warning(std::size_t count, std::size_t rows,
                                   const std::string& version) {
  if (count == 0) return "";
  return "warning: " + std::to_string(count) + " of " + std::to_string(rows) +
         " packings were made by another version than " + version +
         "; run with --fresh to make all anew\n";
}

std::size_t stored_packings(const std::string& folder) {
  return read_journals(folder).outcomes.size();
}

void remove_half_written(const std::string& folder) {
  for (const char* name : tables) remove_leftovers(folder, name);
  remove_leftovers(folder + "/states", ".grains");
  for (const char* slot : {".0", ".1"}) remove_leftovers(folder + "/checkpoints", slot);
}

void remove_results(const std::string& folder) {
  for (const std::string& name : files_in(folder, "journal-", ".jsonl")) {
    remove_file(folder + "/" + name);
  }
  for (const std::string& name : files_in(folder + "/states", "", ".grains")) {
    remove_file(folder + "/states/" + name);
  }
  remove_all_checkpoints(folder);
  for (const char* name : tables) remove_file(folder + "/" + name);
}

}  // namespace grainsweep
