#include <set>

#include <catch2/catch.hpp>

#include "runner/commands/inputs.hpp"
#include "runner/commands/results.hpp"
#include "runner/exit_codes.hpp"
#include "runner/store/checkpoints.hpp"
#include "runner/store/files.hpp"
#include "runner/store/journal.hpp"
#include "runner/store/shard.hpp"
#include "runner/store/states.hpp"
#include "tests/runner/jobs/growing_sweeps.hpp"
#include "tests/runner/sample_rows.hpp"
#include "tests/runner/stored.hpp"
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

/// Flips a bit of the last grain of a bed.
void damage_grains(const std::string& folder, const Outcome& outcome) {
  damage_bed(folder, outcome, outcome.stored_bytes - 20);
}

TEST_CASE("tables and journals are enough to know a folder's results") {
  const TemporaryFolder folder;
  add_outcomes(folder.path(), {sample_outcome("a2", 0.6, 6), sample_outcome("other", 0.6, 6)});
  const std::vector<Row> pending = pending_rows();
  write_tables(folder.path(), stored_provenance(), pending, analyse(pending));
  const Results results = read_results(folder.path());
  REQUIRE(results.rows.size() == 2);
  CHECK(status_of(results.rows[0]) == "pending");
  CHECK(status_of(results.rows[1]) == "settled");
  CHECK(results.orphaned == 1);
  CHECK(stored_packings(folder.path()) == "2 stored packings");
  REQUIRE(results.provenance.runs.size() == 1);
  CHECK(results.provenance.runs[0].process == sample_run().process);
}

TEST_CASE(
    "a run in haste draws no figures, and of many packings leaves tables and page to report") {
  CHECK(extent_at_end(most_in_haste + 1, false) == PageExtent::whole);
  CHECK(extent_at_end(most_in_haste, true) == PageExtent::text);
  CHECK_FALSE(extent_at_end(most_in_haste + 1, true));
}

TEST_CASE("what cannot be read is counted beside the stored packings") {
  const TemporaryFolder folder;
  add_outcomes(folder.path(), {sample_outcome("a1", 0.6, 6)});
  const std::string path = journal_path(folder.path(), "1-of-1"), whole = read_file(path);
  const std::string unread = " of results that cannot be read (damaged, or of another version)";
  replace_file(path, whole + "torn\n");
  CHECK(stored_packings(folder.path()) == "1 stored packing and 1 line or file" + unread);
  replace_file(path, "torn\ntorn\n");
  CHECK(stored_packings(folder.path()) == "2 lines or files" + unread);
}

TEST_CASE("what is called for and what is made of it are of one reading") {
  const TemporaryFolder folder;
  const Sweep whole{"s", 7, 1, growing_group("a", 5.0, 200, {0.01, 0.0})};
  const auto make = [&](int from, int to, const Shard& shard) {
    std::vector<Outcome> outcomes;
    for (int i = from; i <= to; ++i) {
      outcomes.push_back(sample_outcome("a" + std::to_string(i), i % 2 == 0 ? 0.6 : 0.7, 5.5));
    }
    add_outcomes(folder.path(), outcomes, shard);
  };
  make(1, 5, {1, 2});
  GrowingSweep growing(whole, read_journals(folder.path()).outcomes);
  CHECK(growing.now().jobs.size() == 6);
  make(6, 6, {2, 2});  // by another runner, meanwhile: calls for six more
  const Results results =
      read_called_for(growing, stored_provenance(), folder.path(), Detail::whole);
  CHECK(results.rows.size() == 12);
  CHECK(totals_of(results.rows).counts.pending == 6);
  CHECK(results.wishes == wishes_text(whole, read_journals(folder.path()).outcomes));
}

TEST_CASE("a summary counts what the whole results hold") {
  const TemporaryFolder folder;
  Outcome failed = sample_outcome("a1", 0.6, 6);
  failed.result.status = PackingStatus::failed;
  failed.version = "0.0.9";
  add_outcomes(folder.path(), {failed, sample_outcome("other", 0.6, 6)});
  std::vector<Row> rows = pending_rows();
  rows.push_back({sample_job("a3", 7), std::nullopt});
  write_tables(folder.path(), stored_provenance(), rows, analyse(rows));
  add_outcomes(folder.path(), {sample_outcome("a2", 0.6, 6)}, {2, 3});
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

TEST_CASE("files of others are named, those of an output folder are its own") {
  const TemporaryFolder folder;
  CHECK_NOTHROW(expect_no_foreign_files(folder.path() + "/none"));
  replace_file(folder.path() + "/notes.txt", "mine");
  CHECK_NOTHROW(expect_no_foreign_files(folder.path()));
  replace_file(folder.path() + "/groups.csv", "mine");
  replace_file(folder.path() + "/comparison.csv", "mine");
  CHECK_THROWS_WITH(expect_no_foreign_files(folder.path()),
                    Catch::Contains(": holds groups.csv, comparison.csv, though it is no output"));
  make_folder(shards_folder(folder.path()));
  CHECK_NOTHROW(expect_no_foreign_files(folder.path()));
}

TEST_CASE("a packing is named by its id, or by what only it begins with") {
  const std::vector<std::string> ids = {"ab1", "ab", "b2"};
  CHECK(place_of_job("b", ids, "t") == 2);
  CHECK(place_of_job("ab1", ids, "t") == 0);
  CHECK(place_of_job("ab", ids, "t") == 1);
  CHECK_THROWS_WITH(place_of_job("a", ids, "t"), Catch::Contains("several packings begin so"));
  CHECK_THROWS_WITH(place_of_job("c", ids, "t"), Catch::EndsWith("see the column job in t"));
  CHECK_THROWS_AS(place_of_job("", ids, "t"), BadInput);
}

TEST_CASE("a folder without results is refused, and so is a broken provenance") {
  const TemporaryFolder folder;
  CHECK_THROWS_AS(read_results(folder.path()), BadInput);
  CHECK_THROWS_WITH(read_results("-q"), Catch::EndsWith(" run FILE --out ./-q"));
  replace_file(folder.path() + "/provenance.json", "{");
  CHECK_THROWS_WITH(read_results(folder.path()), Catch::Contains("run the sweep again"));
  CHECK_THROWS_WITH(read_results(folder.path(), Detail::summary),
                    Catch::Contains("run the sweep again"));
}

TEST_CASE("what is no output folder, but near one, is told which one to name") {
  const TemporaryFolder folder;
  const std::vector<Row> pending = pending_rows();
  for (const char* name : {"/a", "/b"}) {
    make_folder(folder.path() + name);
    write_provenance(folder.path() + name, stored_provenance(), pending);
  }
  replace_file(folder.path() + "/a.json", "{}");
  const auto refused = [&](const std::string& path, const std::string& advice) {
    CHECK_THROWS_WITH(read_results(folder.path() + path),
                      Catch::Contains("no output folder") && Catch::EndsWith(advice));
  };
  refused("", "; name one of those in it: " + folder.path() + "/a, " + folder.path() + "/b");
  refused("/a.json",
          "; it is a file; name the folder that a run of it wrote, out/NAME of the "
          "sweep or what --out said");
  refused("/a/figures", "; it lies in one; name that, " + folder.path() + "/a");
}

TEST_CASE("the sweep is recorded once, and anew where it is another or damaged") {
  const TemporaryFolder folder;
  const std::string path = folder.path() + "/provenance.json";
  Provenance provenance = stored_provenance();
  const std::vector<Row> rows = pending_rows();
  record_sweep(folder.path(), provenance, rows);
  const std::string recorded = read_file(path);
  provenance.runs.clear();
  record_sweep(folder.path(), provenance, rows);
  CHECK(read_file(path) == recorded);
  record_sweep(folder.path(), provenance, {rows[0]});
  CHECK(read_results(folder.path()).rows.size() == 1);
  replace_file(path, recorded.substr(1));
  record_sweep(folder.path(), provenance, rows);
  CHECK(read_results(folder.path()).rows.size() == 2);
}

/// Two packings of one group, stored with their curves.
std::vector<Row> stored_rows(const TemporaryFolder& folder) {
  std::vector<Row> rows = {settled_row("a1", 5, 0.6, 6), settled_row("a2", 5, 0.61, 6)};
  for (Row& row : rows) {
    add_stored_bed(folder.path(), bed_of(*row.outcome, 1, sample_curves()), *row.outcome);
  }
  return rows;
}

TEST_CASE("tables of curves are made of what is stored with the grains") {
  const TemporaryFolder folder;
  std::vector<Row> rows = stored_rows(folder);
  CHECK(check_beds(folder.path(), rows).empty());
  write_tables(folder.path(), stored_provenance(), rows, analyse(rows, folder.path()));
  const std::string start = "1,MSP,a1,MSP,5,walls,0,";
  CHECK_THAT(read_file(folder.path() + "/profiles.csv"),
             Catch::Contains("\n" + start + "y,0,0.1,,2,2,") &&
                 Catch::Contains("\n" + start + "z,0,0.25,,2,2,0.5,0,0,"));
  CHECK_THAT(read_file(folder.path() + "/distributions.csv"),
             Catch::Contains("\n" + start + "pair_correlation,0.05,0.1,2,0.1,0,0\n"));
  CHECK_THAT(read_file(folder.path() + "/decays.csv"), Catch::Contains("\n" + start + "large,"));
  CHECK_THAT(read_file(folder.path() + "/columns.csv"),
             Catch::Contains("\npackings.csv,coordination_at_1e-05,,") &&
                 Catch::Contains("\ndecays.csv,lambda,d,"));
}

TEST_CASE("a bed that is missing, damaged anywhere or another's is named and its row pending") {
  const TemporaryFolder folder;
  std::vector<Row> rows = stored_rows(folder);
  for (const char* id : {"lost", "swapped", "failed"}) rows.push_back(settled_row(id, 5, 0.6, 6));
  rows[2].outcome->stored_bytes = 1;
  rows[2].outcome->shard = "2-of-2";
  StoredBed other = bed_of(*rows[3].outcome, 1, sample_curves());
  other.state_hash += 1;
  add_stored_bed(folder.path(), other, *rows[3].outcome);
  damage_grains(folder.path(), *rows[1].outcome);
  const auto damage = check_beds(folder.path(), rows);
  REQUIRE(damage.size() == 3);
  CHECK_THAT(damage[0], Catch::Contains("packing a2: damaged, or of another version"));
  CHECK_THAT(damage[1], Catch::Contains("/2-of-2.beds: packing lost: missing"));
  CHECK_THAT(damage[2], Catch::Contains("packing swapped: the bed of another packing"));
  CHECK(status_of(rows[0]) == "settled");
  CHECK(status_of(rows[1]) == "pending");
  CHECK(status_of(rows[4]) == "settled");  // has no bed
  write_tables(folder.path(), stored_provenance(), rows, analyse(rows, folder.path()));
  CHECK_THAT(read_file(folder.path() + "/profiles.csv"), Catch::Contains(",y,0,0.1,,1,1,"));
}

TEST_CASE("a bed that is cut or gone is seen by its size, a flipped bit by reading it") {
  const TemporaryFolder folder;
  const std::vector<Row> stored = stored_rows(folder);
  std::vector<Row> rows = stored;
  CHECK(expect_beds(folder.path(), rows).empty());
  CHECK(check_beds(folder.path(), rows).empty());
  damage_grains(folder.path(), *rows[1].outcome);
  CHECK(expect_beds(folder.path(), rows).empty());
  CHECK(check_beds(folder.path(), rows).size() == 1);
  CHECK(status_of(rows[1]) == "pending");

  rows = stored;
  const std::string path = beds_path(folder.path(), "1-of-1");
  replace_file(path,
               read_file(path).substr(0, static_cast<std::size_t>(file_size(path).value() - 1)));
  auto damage = expect_beds(folder.path(), rows);
  REQUIRE(damage.size() == 1);
  CHECK_THAT(damage[0], Catch::Contains("packing a2: cut off; run the sweep again"));
  CHECK(status_of(rows[0]) == "settled");
  remove_file(path);
  damage = expect_beds(folder.path(), rows);
  REQUIRE(damage.size() == 1);
  CHECK_THAT(damage[0], Catch::Contains("packing a1: missing"));
  rows = stored;
  damage = expect_beds(folder.path(), rows);  // one line for all that miss the same file
  REQUIRE(damage.size() == 1);
  CHECK(damage[0] ==
        path + ": packings a1, a2: missing; run the sweep again to make what is missing anew");
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
  const std::vector<std::string> names = {"packings.csv", "provenance.json", "checkpoints/a1.0",
                                          "checkpoints/a1.1"};
  CheckpointFiles(folder.path(), "a1", "1.0").write({});
  for (const std::string& name : names) {
    replace_file(folder.path() + "/" + name, "whole");
    replace_file(folder.path() + "/" + name + ".tmp.node-77", "half");
  }
  clean_up(folder.path());
  for (const std::string& name : names) {
    CHECK(file_exists(folder.path() + "/" + name));
    CHECK_FALSE(file_exists(folder.path() + "/" + name + ".tmp.node-77"));
  }
}

TEST_CASE("removing tables leaves other files alone") {
  const TemporaryFolder folder;
  CheckpointFiles(folder.path(), "a1", "1.0").write({});
  write_tables(folder.path(), stored_provenance(), {}, {});
  replace_file(folder.path() + "/notes.txt", "mine");
  remove_tables(folder.path());
  CHECK(files_in(folder.path(), "", "") == std::vector<std::string>{"checkpoints", "notes.txt"});
  CHECK(files_in(folder.path() + "/checkpoints", "", "").empty());
}

TEST_CASE("every column of every table has a meaning, and stands in its table once") {
  std::set<std::string> files, columns;
  for (const ColumnText& one : all_columns({1e-5}, {})) {
    files.insert(one.file);
    CHECK(columns.insert(one.file + "/" + one.name).second);
    CHECK_FALSE(one.meaning.empty());
  }
  CHECK(files.size() == 11);
  CHECK(columns.contains("packings.csv/coordination_at_1e-05"));
  CHECK(columns.contains("fits.csv/zeta"));
}

}  // namespace
}  // namespace grainsweep
