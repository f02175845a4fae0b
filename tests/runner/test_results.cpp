#include <catch2/catch.hpp>

#include "runner/exit_codes.hpp"
#include "runner/results.hpp"
#include "runner/store/checkpoints.hpp"
#include "runner/store/files.hpp"
#include "runner/store/journal.hpp"
#include "runner/store/states.hpp"
#include "tests/runner/sample_rows.hpp"
#include "tests/runner/temporary_folder.hpp"

namespace grainsweep {
namespace {

Provenance sample_provenance() {
  Provenance provenance;
  provenance.sweep_file = "a.json";
  provenance.sweep = {"a", {sample_job("a1", 5), sample_job("a2", 6)}};
  provenance.runs.emplace_back();
  return provenance;
}

TEST_CASE("tables and journals are enough to know a folder's results") {
  const TemporaryFolder folder;
  Journal journal(folder.path());
  journal.append(sample_outcome("a2", 0.6, 6));
  journal.append(sample_outcome("other", 0.6, 6));
  write_tables(folder.path(), sample_provenance(), {});
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
  Provenance provenance = sample_provenance();
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

TEST_CASE("a packing counts as finished with its grains stored and without an exception") {
  const TemporaryFolder folder;
  Outcome whole = sample_outcome("whole", 0.6, 6), lost = whole, thrown = whole, failed = whole;
  whole.stored_grains = lost.stored_grains = 1;
  thrown.threw = true;
  failed.result.status = PackingStatus::failed;
  write_bed(folder.path(), "whole", {{}, {{}}});
  const auto finished = finished_outcomes(
      folder.path(), {{"whole", whole}, {"lost", lost}, {"thrown", thrown}, {"failed", failed}});
  CHECK(finished.size() == 2);
  CHECK(finished.contains("whole"));
  CHECK(finished.contains("failed"));
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
  write_tables(folder.path(), sample_provenance(), {});
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
