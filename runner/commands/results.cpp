#include "runner/commands/results.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <iostream>
#include <list>
#include <map>
#include <optional>
#include <system_error>
#include <utility>

#include <nlohmann/json.hpp>

#include "runner/compare/comparison_table.hpp"
#include "runner/exit_codes.hpp"
#include "runner/machine.hpp"
#include "runner/store/checkpoints.hpp"
#include "runner/store/claims.hpp"
#include "runner/store/files.hpp"
#include "runner/store/shard.hpp"
#include "runner/sweep/text_lines.hpp"
#include "runner/tables/component_profiles.hpp"
#include "runner/tables/components.hpp"
#include "runner/tables/decays.hpp"
#include "runner/tables/distributions.hpp"
#include "runner/tables/fits.hpp"
#include "runner/tables/packings.hpp"
#include "runner/tables/profiles.hpp"
#include "runner/tables/sizes.hpp"
#include "runner/text.hpp"
#include "runner/versions.hpp"

namespace grainsweep {
std::string provenance_path(const std::string& folder) { return folder + "/provenance.json"; }

namespace {

constexpr std::array tables = {"packings.csv",           "groups.csv",   "fits.csv",
                               "fit_points.csv",         "profiles.csv", "decays.csv",
                               "distributions.csv",      "sizes.csv",    "components.csv",
                               "component_profiles.csv", "columns.csv",  "provenance.json"};

bool has_results(const std::string& folder) { return file_exists(provenance_path(folder)); }

/// "out/a, out/b and 3 more", the output folders in a folder; empty if there are none.
std::string output_folders_in(const std::string& folder) {
  constexpr std::size_t most_named = 4;
  std::string text;
  std::size_t count = 0;
  for (const std::string& name : files_in(folder, "", "")) {
    const std::string inside = (std::filesystem::path(folder) / name).string();
    if (!has_results(inside) || ++count > most_named) continue;
    text += (text.empty() ? "" : ", ") + shell_path(inside);
  }
  return text + (count > most_named ? " and " + std::to_string(count - most_named) + " more" : "");
}

/// What to do where `path` is no output folder.
std::string instead_of(const std::string& path) {
  const std::filesystem::path given(path);
  std::error_code not_there;
  const bool is_file = std::filesystem::is_regular_file(given, not_there);
  const std::string parent = given.parent_path().string();
  if (!parent.empty() && has_results(parent)) {
    return "it lies in one; name that, " + shell_path(parent);
  }
  if (is_file) {
    const std::string usual = (std::filesystem::path("out") / given.stem()).string();
    return "it is a file; name the folder that a run of it wrote, " +
           (has_results(usual) ? shell_path(usual) : "out/NAME of the sweep or what --out said");
  }
  if (std::filesystem::is_directory(given, not_there)) {
    const std::string inside = output_folders_in(path);
    if (!inside.empty()) return "name one of those in it: " + inside;
  }
  return "make one with " + called_as() + " run FILE --out " + shell_path(path);
}

/// Reads provenance.json. Throws BadInput.
ProvenanceReading read_provenance(const std::string& folder) {
  const std::string path = provenance_path(folder);
  if (!file_exists(path)) {
    throw BadInput(folder + ": no output folder of grainsweep (it has no provenance.json); " +
                   instead_of(folder));
  }
  const std::string text = read_file(path);
  try {
    return provenance_from_text(text);
  } catch (const nlohmann::json::exception&) {
    const std::string what = has_checksum(text) ? "of another version of grainsweep"
                                                : "cut off, or changed since it was written";
    throw BadInput(path + ": " + what +
                   "; run the sweep again to write it anew, stored packings are kept");
  }
}

/// Whether provenance.json is of this program, these sweeps and these jobs.
bool is_recorded(const std::string& folder, const Provenance& provenance,
                 const std::vector<Row>& rows) {
  if (!file_exists(provenance_path(folder))) return false;
  try {
    const ProvenanceReading known = read_provenance(folder);
    return known.provenance.build == provenance.build &&
           known.provenance.sweeps == provenance.sweeps &&
           std::equal(known.jobs.jobs.begin(), known.jobs.jobs.end(), rows.begin(), rows.end(),
                      [](const JobEntry& a, const Row& b) { return a.id == b.job.id; });
  } catch (const BadInput&) {
    return false;
  }
}

/// What to do about beds that are not sound.
constexpr std::string_view run_again = "run the sweep again to make what is missing anew";

/// Calls `use` with an outcome that has a stored bed; if that throws FileError because the bed is
/// not sound, returns false and appends what is wrong to `faults`.
template <class Use>
bool uses_bed(const Outcome& outcome, Use& use, std::vector<BedFault>& faults) {
  if (outcome.stored_bytes == 0) return true;
  try {
    use(outcome);
    return true;
  } catch (const FileError& error) {
    faults.push_back(fault_of_bed(outcome.job, error));
    return false;
  }
}

/// The same for each row's outcome; a row without a sound bed becomes pending.
template <class Use>
std::vector<std::string> use_beds(std::vector<Row>& rows, Use use) {
  std::vector<BedFault> faults;
  for (Row& row : rows) {
    if (row.outcome && !uses_bed(*row.outcome, use, faults)) row.outcome.reset();
  }
  return lines_of(faults, run_again);
}

/// Throws FileError where a stored bed is not there with the size that it had. Asks for the size of
/// each file once.
class ExpectBed {
 public:
  explicit ExpectBed(std::string folder) : folder_(std::move(folder)) {}
  void operator()(const Outcome& outcome) {
    const auto [size, is_new] = sizes_.try_emplace(outcome.shard);
    if (is_new) size->second = file_size(beds_path(folder_, outcome.shard));
    expect_bed(folder_, outcome, size->second);
  }

 private:
  std::string folder_;
  std::map<std::string, std::optional<std::int64_t>> sizes_;  // by shard
};

void write_packings(const std::string& folder, const std::vector<Row>& rows,
                    const std::vector<Group>& groups, const GivenUnits& units) {
  Replacement file(folder + "/packings.csv");
  write_packings_csv(rows, groups, units, [&](const std::string& line) { file.write(line); });
  file.commit();
}

/// All tables that need curves.
std::vector<CurveTable> curve_tables(const Varied& varied, const GivenUnits& units) {
  return {profiles_table(varied, units),      decays_table(varied, units),
          distributions_table(varied, units), sizes_table(varied, units),
          components_table(varied, units),    component_profiles_table(varied, units)};
}

/// A table, and the file that it is written to.
struct CurveFile {
  CurveFile(const std::string& folder, CurveTable its_table)
      : file(folder + "/" + its_table.file), table(std::move(its_table)) {
    file.write(table.header);
  }

  Replacement file;
  CurveTable table;
};

/// Writes all of them at once, so that each bed is read once, and only those of one group are in
/// memory.
void write_curve_tables(const std::string& folder, const Analysis& analysis,
                        const GivenUnits& units) {
  std::list<CurveFile> files;
  for (CurveTable& table : curve_tables(varied_of(analysis.groups), units)) {
    files.emplace_back(folder, std::move(table));
  }
  for (const Group& group : analysis.groups) {
    const GroupWithCurves with_curves(group, analysis.folder);
    for (CurveFile& one : files) one.file.write(one.table.lines(*with_curves));
  }
  for (CurveFile& one : files) one.file.commit();
}

}  // namespace

void expect_no_foreign_files(const std::string& folder) {
  if (has_results(folder) || file_exists(shards_folder(folder))) return;
  std::string names;
  const auto look = [&](const std::string& name) {
    if (file_exists(folder + "/" + name)) names += (names.empty() ? "" : ", ") + name;
  };
  for (const char* name : tables) look(name);
  for (const char* name : {"report.html", "comparison.csv"}) look(name);
  if (names.empty()) return;
  throw BadInput(folder + ": holds " + names +
                 ", though it is no output folder of grainsweep, and would lose them; name another "
                 "folder with --out, or move them away");
}

void expect_results(const std::string& folder) {
  const std::string path = provenance_path(folder);
  if (!file_exists(path) || !has_checksum(read_file(path))) read_provenance(folder);
}

StoredSweep read_stored_sweep(const std::string& folder, Detail detail) {
  ProvenanceReading reading = read_provenance(folder);
  JournalReading journals = read_journals(folder, detail);
  reading.provenance.runs = std::move(journals.runs);
  return {std::move(reading.provenance), std::move(reading.jobs), std::move(journals.outcomes),
          std::move(journals.last_runs), std::move(journals.damage)};
}

Results read_results(const std::string& folder, Detail detail) {
  StoredSweep stored = read_stored_sweep(folder, detail);
  Results results{std::move(stored.provenance), rows_of(stored.jobs, detail),
                  std::move(stored.damage), std::move(stored.last_runs), 0};
  results.orphaned = take_outcomes(std::move(stored.outcomes), results.rows);
  return results;
}

Results read_called_for(GrowingSweep& growing, Provenance provenance, const std::string& folder,
                        Detail detail) {
  JournalReading stored = read_journals(folder, detail);
  growing.grow(stored.outcomes);
  Results results{std::move(provenance),          rows_of(growing.now()), {}, {}, 0,
                  growing.wishes(stored.outcomes)};
  results.provenance.runs = std::move(stored.runs);
  results.orphaned = take_outcomes(std::move(stored.outcomes), results.rows);
  return results;
}

void record_sweep(const std::string& folder, const Provenance& provenance,
                  const std::vector<Row>& rows) {
  if (!is_recorded(folder, provenance, rows)) write_provenance(folder, provenance, rows);
}

bool lacks_grains(const Outcome& outcome) { return outcome.stored_bytes > 0 && !outcome.bed; }

std::string grains_remedy(const std::string& sweep_file, const std::string& folder) {
  return called_as() + " run " + (sweep_file.empty() ? "FILE" : shell_path(sweep_file)) +
         " --out " + shell_path(folder) +
         " --with-grains makes them again with grains, with --job ID one of them";
}

std::string others_remedy(const std::string& folder) {
  return "; " + called_as() + " collect " + shell_path(folder) +
         " --out OTHER --current leaves them behind";
}

bool has_sound_bed(const std::string& folder, const Outcome& outcome,
                   std::vector<BedFault>& faults) {
  const auto read = [&](const Outcome& of) { read_bed(folder, of); };
  return uses_bed(outcome, read, faults);
}

std::vector<std::string> check_beds(const std::string& folder, std::vector<Row>& rows) {
  return use_beds(rows, [&](const Outcome& outcome) { read_bed(folder, outcome); });
}

std::vector<std::string> expect_beds(const std::string& folder, std::vector<Row>& rows) {
  return use_beds(rows, ExpectBed(folder));
}

std::vector<std::string> expect_beds(const std::string& folder, Outcomes& outcomes) {
  ExpectBed expect(folder);
  std::vector<BedFault> faults;
  std::erase_if(outcomes,
                [&](const auto& of_job) { return !uses_bed(*of_job.second, expect, faults); });
  std::vector<std::string> damage = lines_of(faults, run_again);
  std::sort(damage.begin(), damage.end());  // outcomes have no order
  return damage;
}

void write_tables(const std::string& folder, const Provenance& provenance,
                  const std::vector<Row>& rows, const Analysis& analysis) {
  const auto& [groups, families, beds] = analysis;
  const GivenUnits& units = provenance.units;
  write_packings(folder, rows, groups, units);
  replace_file(folder + "/groups.csv", groups_csv(groups, units));
  replace_file(folder + "/fits.csv", fits_csv(families, units));
  replace_file(folder + "/fit_points.csv", fit_points_csv(families, units));
  write_curve_tables(folder, analysis, units);
  replace_file(folder + "/columns.csv",
               columns_csv(all_columns(further_tolerances(groups), varied_of(groups), units)));
  write_provenance(folder, provenance, rows);
}

void write_provenance(const std::string& folder, const Provenance& provenance,
                      const std::vector<Row>& rows) {
  replace_file(provenance_path(folder), provenance_text(provenance, rows));
}

std::optional<PageExtent> extent_at_end(std::size_t packings, bool is_in_haste) {
  if (!is_in_haste) return PageExtent::whole;
  return packings <= most_in_haste ? std::optional(PageExtent::text) : std::nullopt;
}

std::string write_page(const std::string& folder, const Provenance& provenance,
                       const std::vector<Row>& rows, const Analysis& analysis, PageExtent extent) {
  for (const std::string& line : write_report(folder, provenance, rows, analysis, extent)) {
    std::cerr << "note: " << line << "\n";
  }
  return "Page to look at: " + folder + "/report.html\n";
}

Build this_build() {
  return {program_version(), source_commit(), compiler_version(), library_versions()};
}

std::vector<ColumnText> all_columns(const std::vector<double>& tolerances, const Varied& varied,
                                    const GivenUnits& units) {
  std::vector<ColumnText> all;
  const auto add = [&](const std::vector<ColumnText>& some) {
    all.insert(all.end(), some.begin(), some.end());
  };
  add(described("packings.csv", packings_columns(tolerances, varied, units)));
  add(described("groups.csv", groups_columns(tolerances, varied, units)));
  for (const CurveTable& table : curve_tables(varied, units)) add(table.columns);
  add(fits_columns(units));
  add(fit_points_columns(varied, units));
  add(comparison_columns(units));
  return all;
}

std::string damage_warnings(const std::vector<std::string>& damage) {
  std::string text;
  for (const std::string& line : damage) text += "warning: " + without_controls(line) + "\n";
  return text;
}

std::string other_versions_warning(const std::vector<Row>& rows, const std::string& version) {
  const auto is_other = [&](const Row& row) {
    return row.outcome && row.outcome->version != version;
  };
  const auto count = std::count_if(rows.begin(), rows.end(), is_other);
  if (count == 0) return "";
  return "warning: " + std::to_string(count) + " of " + counted(rows.size(), "packing") +
         (rows.size() == 1 ? " was" : " were") + " made by another version than " + version +
         "; run with --fresh to make all anew\n";
}

std::string stored_packings(const std::string& folder) {
  const JournalReading stored = read_journals(folder, Detail::summary);
  std::string text;
  if (!stored.outcomes.empty()) text = counted(stored.outcomes.size(), "stored packing");
  if (stored.unread == 0) return text;
  return text + (text.empty() ? "" : " and ") + std::to_string(stored.unread) +
         (stored.unread == 1 ? " line or file" : " lines or files") +
         " of results that cannot be read (damaged, or of another version)";
}

void clean_up(const std::string& folder) {
  forget_claims(folder);
  for (const char* name : tables) remove_leftovers(folder, name);
  for (const char* name : {"report.html", "comparison.csv", "reference.json"})
    remove_leftovers(folder, name);
  for (const char* ending : {".csv", ".gnuplot"}) remove_leftovers(folder + "/figures", ending);
  for (const char* slot : {".0", ".1"}) remove_leftovers(folder + "/checkpoints", slot);
}

void warn_without_lock(const std::string& folder, const ShardFiles& files) {
  if (files.is_locked()) return;
  std::cerr << "warning: " << folder
            << ": its file system offers no lock; let no other run make the same packings here\n";
}

void remove_tables(const std::string& folder) {
  std::cerr << damage_warnings(remove_all_checkpoints(folder));
  for (const char* name : tables) remove_file(folder + "/" + name);
  remove_report(folder);
}

}  // namespace grainsweep
