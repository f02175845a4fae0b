#include <set>

#include <catch2/catch.hpp>

#include "runner/commands/results.hpp"
#include "runner/exit_codes.hpp"
#include "runner/store/checkpoints.hpp"
#include "runner/store/files.hpp"
#include "runner/store/journal.hpp"
#include "runner/store/states.hpp"
#include "tests/runner/sample_rows.hpp"
#include "tests/runner/temporary_folder.hpp"

namespace grainsweep {
namespace {

Provenance stored_provenance() {
  Provenance provenance;
  provenance.sweeps = {{"a.json", ""}};
  provenance.sweep_name = "a";
  provenance.runs.emplace_back();
  return provenance;
}

std::vector<Row> pending_rows() {
  return {{sample_job("a1", 5), std::nullopt}, {sample_job("a2", 6), std::nullopt}};
}

/// The bed of an outcome with one grain.
StoredBed bed_of(const Outcome& outcome) {
  return {outcome.job, outcome.result.state_hash, {}, sample_curves(), {{}}, {}, {}};
}

/// Flips a bit of the last grain of a bed.
void damage_bed(const std::string& folder, const std::string& job) {
  std::string bytes = read_file(state_path(folder, job));
  bytes[bytes.size() - 20] = static_cast<char>(bytes[bytes.size() - 20] ^ 1);
  replace_file(state_path(folder, job), bytes);
}

TEST_CASE("tables and journals are enough to know a folder's results") {
  const TemporaryFolder folder;
  Journal journal(folder.path());
  journal.append(sample_outcome("a2", 0.6, 6));
  journal.append(sample_outcome("other", 0.6, 6));
  const std::vector<Row> pending = pending_rows();
  write_tables(folder.path(), stored_provenance(), pending, analyse(pending));
  const Results results = read_results(folder.path());
  REQUIRE(results.rows.size() == 2);
  CHECK(status_of(results.rows[0]) == "pending");
  CHECK(status_of(results.rows[1]) == "settled");
  CHECK(results.orphaned == 1);
  CHECK(stored_packings(folder.path()) == 2);
  std::vector<std::string> damage;
  CHECK(recorded_runs(folder.path(), damage).size() == 1);
  CHECK(damage.empty());
}

TEST_CASE("a summary counts what the whole results hold") {
  const TemporaryFolder folder;
  Journal journal(folder.path());
  Outcome failed = sample_outcome("a1", 0.6, 6);
  failed.result.status = PackingStatus::failed;
  failed.version = "0.0.9";
  journal.append(failed);
  journal.append(sample_outcome("other", 0.6, 6));
  std::vector<Row> rows = pending_rows();
  rows.push_back({sample_job("a3", 7), std::nullopt});
  write_tables(folder.path(), stored_provenance(), rows, analyse(rows));
  journal.append(sample_outcome("a2", 0.6, 6));
  const Results whole = read_results(folder.path());
  const Results summary = read_results(folder.path(), Detail::summary);
  CHECK(summary.provenance.sweep_name == "a");
  CHECK(sweep_file_of(summary.provenance) == "a.json");
  CHECK(summary.rows.size() == 3);
  const Totals expected = totals_of(whole.rows), totals = totals_of(summary.rows);
  CHECK(totals.counts.settled == 1);
  CHECK(totals.counts.not_settled == 0);
  CHECK(totals.counts.failed == 1);
  CHECK(totals.counts.pending == expected.counts.pending);
  CHECK(totals.cpu_seconds == expected.cpu_seconds);
  CHECK(summary.orphaned == whole.orphaned);
  CHECK(summary.damage.empty());
  CHECK(other_versions_warning(summary.rows, "").starts_with("warning: 1 of 3 packings"));
}

TEST_CASE("a folder without results is refused, and so is a broken provenance") {
  const TemporaryFolder folder;
  std::vector<std::string> damage;
  CHECK_THROWS_AS(read_results(folder.path()), BadInput);
  CHECK(recorded_runs(folder.path(), damage).empty());
  CHECK(damage.empty());
  replace_file(folder.path() + "/provenance.json", "{");
  CHECK_THROWS_WITH(read_results(folder.path()), Catch::Contains("run the sweep again"));
  CHECK_THROWS_WITH(read_results(folder.path(), Detail::summary),
                    Catch::Contains("run the sweep again"));
  CHECK(recorded_runs(folder.path(), damage).empty());
  REQUIRE(damage.size() == 1);
  CHECK_THAT(damage[0], Catch::Contains("/provenance.json: damaged"));
  const auto kept = files_in(folder.path(), "damaged-provenance-", ".json");
  REQUIRE(kept.size() == 1);
  CHECK_THAT(damage[0], Catch::Contains(kept[0]));
  CHECK(read_file(folder.path() + "/" + kept[0]) == "{");
  remove_results(folder.path());
  CHECK(files_in(folder.path(), "", "").empty());
}

/// Two packings of one group, stored with their curves.
std::vector<Row> stored_rows(const TemporaryFolder& folder) {
  std::vector<Row> rows = {settled_row("a1", 5, 0.6, 6), settled_row("a2", 5, 0.61, 6)};
  for (Row& row : rows) {
    row.outcome->stored_bytes = write_bed(folder.path(), bed_of(*row.outcome));
  }
  return rows;
}

TEST_CASE("tables of curves are made of what is stored with the grains") {
  const TemporaryFolder folder;
  std::vector<Row> rows = stored_rows(folder);
  CHECK(load_curves(folder.path(), rows).empty());
  write_tables(folder.path(), stored_provenance(), rows, analyse(rows));
  const std::string start = "1,MSP,a1,MSP,5,walls,0,";
  CHECK_THAT(read_file(folder.path() + "/profiles.csv"),
             Catch::Contains("\n" + start + "y,0,0.1,2,2,") &&
                 Catch::Contains("\n" + start + "z,0,0.25,2,2,0.5,0,0,"));
  CHECK_THAT(read_file(folder.path() + "/distributions.csv"),
             Catch::Contains("\n" + start + "pair_correlation,0.05,0.1,2,0.1,0,0\n"));
  CHECK_THAT(read_file(folder.path() + "/decays.csv"), Catch::Contains("\n" + start + "large,"));
  CHECK_THAT(read_file(folder.path() + "/columns.csv"),
             Catch::Contains("\npackings.csv,coordination_at_1e-05,,") ||
                 Catch::Contains("\ndecays.csv,lambda,d,"));
}

TEST_CASE("a bed that is missing, damaged anywhere or another's is named and its row pending") {
  const TemporaryFolder folder;
  std::vector<Row> rows = stored_rows(folder);
  for (const char* id : {"lost", "swapped", "failed"}) rows.push_back(settled_row(id, 5, 0.6, 6));
  rows[2].outcome->stored_bytes = 1;
  rows[3].outcome->stored_bytes = 1;
  StoredBed other = bed_of(*rows[3].outcome);
  other.state_hash += 1;
  write_bed(folder.path(), other);
  damage_bed(folder.path(), "a2");
  const auto damage = load_curves(folder.path(), rows);
  REQUIRE(damage.size() == 3);
  CHECK_THAT(damage[0], Catch::Contains("/states/a2.grains: damaged, or of another version"));
  CHECK_THAT(damage[1], Catch::Contains("/states/lost.grains: missing"));
  CHECK_THAT(damage[2], Catch::Contains("/states/swapped.grains: the bed of another packing"));
  CHECK(rows[0].outcome->result.profile_y.bins.size() == 2);
  CHECK(status_of(rows[1]) == "pending");
  CHECK(status_of(rows[4]) == "settled");  // has no bed
  write_tables(folder.path(), stored_provenance(), rows, analyse(rows));
  CHECK_THAT(read_file(folder.path() + "/profiles.csv"), Catch::Contains(",y,0,0.1,1,1,"));
}

TEST_CASE("a bed that is cut or gone is seen by its size, a flipped bit by reading it") {
  const TemporaryFolder folder;
  const std::vector<Row> stored = stored_rows(folder);
  std::vector<Row> rows = stored;
  CHECK(expect_beds(folder.path(), rows).empty());
  CHECK(check_beds(folder.path(), rows).empty());
  damage_bed(folder.path(), "a2");
  CHECK(expect_beds(folder.path(), rows).empty());
  CHECK(check_beds(folder.path(), rows).size() == 1);
  CHECK(status_of(rows[1]) == "pending");

  rows = stored;
  remove_file(state_path(folder.path(), "a1"));
  replace_file(state_path(folder.path(), "a2"), "GRAINS6");
  const auto damage = expect_beds(folder.path(), rows);
  REQUIRE(damage.size() == 2);
  CHECK_THAT(damage[0], Catch::Contains("/states/a1.grains: missing; run the sweep again"));
  CHECK_THAT(damage[1], Catch::Contains("/states/a2.grains: damaged"));
  CHECK(status_of(rows[0]) == "pending");
  CHECK(status_of(rows[1]) == "pending");
}

TEST_CASE("packings of another version of the program are counted") {
  Row other = settled_row("a1", 5, 0.6, 6), own = settled_row("a2", 6, 0.6, 6), pending = own;
  other.outcome->version = "1.0.0";
  own.outcome->version = "2.0.0";
  pending.outcome.reset();
  CHECK(other_versions_warning({own, pending}, "2.0.0").empty());
  CHECK_THAT(other_versions_warning({own, other, pending}, "2.0.0"),
             Catch::StartsWith("warning: 1 of 3 packings were made by another version than 2.0.0"));
}

TEST_CASE("half written files of every kind are removed, whole ones stay") {
  const TemporaryFolder folder;
  const std::vector<std::string> names = {"packings.csv", "provenance.json", "states/a1.grains",
                                          "checkpoints/a1.0", "checkpoints/a1.1"};
  write_bed(folder.path(), bed_of(sample_outcome("a1", 0.6, 6)));
  CheckpointFiles(folder.path(), "a1", "1.0").write({});
  for (const std::string& name : names) {
    replace_file(folder.path() + "/" + name, "whole");
    replace_file(folder.path() + "/" + name + ".tmp.77", "half");
  }
  clean_up(folder.path(), FolderLock(folder.path()));
  for (const std::string& name : names) {
    CHECK(file_exists(folder.path() + "/" + name));
    CHECK_FALSE(file_exists(folder.path() + "/" + name + ".tmp.77"));
  }
}

TEST_CASE("removing results leaves other files alone") {
  const TemporaryFolder folder;
  Journal(folder.path()).append(sample_outcome("a1", 0.6, 6));
  write_bed(folder.path(), bed_of(sample_outcome("a1", 0.6, 6)));
  CheckpointFiles(folder.path(), "a1", "1.0").write({});
  write_tables(folder.path(), stored_provenance(), {}, {});
  replace_file(folder.path() + "/notes.txt", "mine");
  replace_file(folder.path() + "/states/notes.txt", "mine");
  remove_results(folder.path());
  CHECK(files_in(folder.path(), "", "") ==
        std::vector<std::string>{"checkpoints", "notes.txt", "states"});
  CHECK(files_in(folder.path() + "/checkpoints", "", "").empty());
  CHECK(files_in(folder.path() + "/states", "", "") == std::vector<std::string>{"notes.txt"});
}

TEST_CASE("every column of every table has a meaning, and stands in its table once") {
  std::set<std::string> files, columns;
  for (const ColumnText& one : all_columns({1e-5}, {})) {
    files.insert(one.file);
    CHECK(columns.insert(one.file + "/" + one.name).second);
    CHECK_FALSE(one.meaning.empty());
  }
  CHECK(files.size() == 7);
  CHECK(columns.contains("packings.csv/coordination_at_1e-05"));
  CHECK(columns.contains("fits.csv/zeta"));
}

}  // namespace
}  // namespace grainsweep
