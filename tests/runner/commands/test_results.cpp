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
  provenance.sweep_file = "a.json";
  provenance.sweep = {"a", {sample_job("a1", 5), sample_job("a2", 6)}};
  provenance.runs.emplace_back();
  return provenance;
}

/// Flips a bit of the first number of a bed's curves.
void damage_curves(const std::string& folder, const std::string& job) {
  std::string bytes = read_file(state_path(folder, job));
  bytes[20] = static_cast<char>(bytes[20] ^ 1);
  replace_file(state_path(folder, job), bytes);
}

TEST_CASE("tables and journals are enough to know a folder's results") {
  const TemporaryFolder folder;
  Journal journal(folder.path());
  journal.append(sample_outcome("a2", 0.6, 6));
  journal.append(sample_outcome("other", 0.6, 6));
  write_tables(folder.path(), stored_provenance(), {});
  const Results results = read_results(folder.path());
  REQUIRE(results.rows.size() == 2);
  CHECK(status_of(results.rows[0]) == "pending");
  CHECK(status_of(results.rows[1]) == "settled");
  CHECK(results.foreign == 1);
  CHECK(stored_packings(folder.path()) == 2);
  CHECK(recorded_runs(folder.path()).size() == 1);
}

TEST_CASE("an overview counts what the whole results hold") {
  const TemporaryFolder folder;
  Journal journal(folder.path());
  Outcome failed = sample_outcome("a1", 0.6, 6);
  failed.result.status = PackingStatus::failed;
  failed.version = "0.0.9";
  journal.append(failed);
  journal.append(sample_outcome("other", 0.6, 6));
  Provenance provenance = stored_provenance();
  provenance.sweep.jobs.push_back(sample_job("a3", 7));
  write_tables(folder.path(), provenance, {});
  journal.append(sample_outcome("a2", 0.6, 6));
  const Results results = read_results(folder.path());
  const Totals totals = totals_of(results.rows);
  const Overview overview = read_overview(folder.path(), "");
  CHECK(overview.name == "a");
  CHECK(overview.sweep_file == "a.json");
  CHECK(overview.packings == results.rows.size());
  CHECK(overview.counts.settled == 1);
  CHECK(overview.counts.not_settled == 0);
  CHECK(overview.counts.failed == 1);
  CHECK(overview.counts.pending == totals.counts.pending);
  CHECK(overview.cpu_seconds == totals.cpu_seconds);
  CHECK(overview.foreign == results.foreign);
  CHECK(overview.other_versions == 1);
  CHECK(overview.damage.empty());
}

TEST_CASE("a folder without results is refused, and so is a broken provenance") {
  const TemporaryFolder folder;
  CHECK_THROWS_AS(read_results(folder.path()), BadInput);
  CHECK_THROWS_AS(read_overview(folder.path(), ""), BadInput);
  CHECK(recorded_runs(folder.path()).empty());
  replace_file(folder.path() + "/provenance.json", "{");
  CHECK_THROWS_WITH(read_results(folder.path()), Catch::Contains("run the sweep again"));
  CHECK_THROWS_WITH(read_overview(folder.path(), ""), Catch::Contains("run the sweep again"));
  CHECK(recorded_runs(folder.path()).empty());
}

TEST_CASE("a packing counts as finished with its bed stored and without an exception") {
  const TemporaryFolder folder;
  Journal journal(folder.path());
  for (const char* job : {"whole", "lost", "damaged", "thrown", "failed"}) {
    Outcome outcome = sample_outcome(job, 0.6, 6);
    outcome.stored_grains = std::string_view(job) == "failed" ? 0 : 1;
    outcome.threw = std::string_view(job) == "thrown";
    outcome.result.status =
        outcome.stored_grains == 0 ? PackingStatus::failed : outcome.result.status;
    journal.append(outcome);
    if (std::string_view(job) != "lost") write_bed(folder.path(), job, {{}, {{}}, sample_curves()});
  }
  damage_curves(folder.path(), "damaged");
  const JournalReading finished = finished_outcomes(folder.path());
  CHECK(finished.outcomes.size() == 2);
  CHECK(finished.outcomes.contains("whole"));
  CHECK(finished.outcomes.contains("failed"));
  CHECK(stored_outcomes(folder.path()).outcomes.size() == 3);
  REQUIRE(finished.damage.size() == 2);
  CHECK(finished.damage[0] ==
        "states/damaged.grains: missing, damaged or of another version; left out, its packing is "
        "made again");
  CHECK_THAT(finished.damage[1], Catch::StartsWith("states/lost.grains: missing"));
}

/// Two packings of one group, stored with their curves.
std::vector<Row> stored_rows(const TemporaryFolder& folder) {
  std::vector<Row> rows = {settled_row("a1", 5, 0.6, 6), settled_row("a2", 5, 0.61, 6)};
  for (Row& row : rows) {
    row.outcome->stored_grains = 1;
    write_bed(folder.path(), row.job.id, {{}, {{}}, sample_curves()});
  }
  return rows;
}

TEST_CASE("tables of curves are made of what is stored with the grains") {
  const TemporaryFolder folder;
  const std::vector<Row> rows = stored_rows(folder);
  write_tables(folder.path(), stored_provenance(), rows);
  const std::string start = "1,MSP,5,walls,0,";
  CHECK_THAT(read_file(folder.path() + "/profiles.csv"),
             Catch::Contains("\n" + start + "y,0,0.1,2,2,") &&
                 Catch::Contains("\n" + start + "z,0,0.25,2,2,0.5,0,"));
  CHECK_THAT(read_file(folder.path() + "/distributions.csv"),
             Catch::Contains("\n" + start + "pair_correlation,0.05,0.1,2,0.1,0\n"));
  CHECK_THAT(read_file(folder.path() + "/decays.csv"), Catch::Contains("\n" + start + "large,"));
}

TEST_CASE("damaged curves are named, and never left out of a table in silence") {
  const TemporaryFolder folder;
  std::vector<Row> rows = stored_rows(folder);
  damage_curves(folder.path(), "a2");
  CHECK_THROWS_WITH(write_tables(folder.path(), stored_provenance(), rows),
                    Catch::Contains("/states/a2.grains: missing, damaged or of another version; "
                                    "run the sweep again"));
  CHECK(load_curves(folder.path(), rows).size() == 1);
  CHECK(rows[0].outcome->result.profile_y.bins.size() == 2);
  CHECK(status_of(rows[1]) == "pending");
  write_tables(folder.path(), stored_provenance(), rows);
  CHECK_THAT(read_file(folder.path() + "/profiles.csv"), Catch::Contains(",y,0,0.1,1,1,"));
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
  write_bed(folder.path(), "a1", {});
  CheckpointFiles(folder.path(), "a1", "1.0").write({});
  for (const std::string& name : names) {
    replace_file(folder.path() + "/" + name, "whole");
    replace_file(folder.path() + "/" + name + ".tmp.77", "half");
  }
  remove_half_written(folder.path());
  for (const std::string& name : names) {
    CHECK(file_exists(folder.path() + "/" + name));
    CHECK_FALSE(file_exists(folder.path() + "/" + name + ".tmp.77"));
  }
}

TEST_CASE("removing results leaves other files alone") {
  const TemporaryFolder folder;
  Journal(folder.path()).append(sample_outcome("a1", 0.6, 6));
  write_bed(folder.path(), "a1", {});
  CheckpointFiles(folder.path(), "a1", "1.0").write({});
  write_tables(folder.path(), stored_provenance(), {});
  replace_file(folder.path() + "/notes.txt", "mine");
  replace_file(folder.path() + "/states/notes.txt", "mine");
  remove_results(folder.path());
  CHECK(files_in(folder.path(), "", "") ==
        std::vector<std::string>{"checkpoints", "notes.txt", "states"});
  CHECK(files_in(folder.path() + "/checkpoints", "", "").empty());
  CHECK(files_in(folder.path() + "/states", "", "") == std::vector<std::string>{"notes.txt"});
}

}  // namespace
}  // namespace grainsweep
