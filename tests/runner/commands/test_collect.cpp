#include <catch2/catch.hpp>

#include "runner/commands/commands.hpp"
#include "runner/commands/results.hpp"
#include "runner/exit_codes.hpp"
#include "runner/store/files.hpp"
#include "runner/store/journal.hpp"
#include "runner/versions.hpp"
#include "tests/runner/commands/captured.hpp"
#include "tests/runner/sample_rows.hpp"
#include "tests/runner/stored.hpp"
#include "tests/runner/temporary_folder.hpp"

namespace grainsweep {
namespace {

using Catch::Contains;

/// The folder of a run by process "node-7" that began at `started` and made one packing.
std::string folder_of_a_run(const TemporaryFolder& parent, const std::string& name,
                            const std::string& started, const Outcome& outcome,
                            const GivenUnits& units = {}, const std::string& label = "MSP",
                            const std::map<std::string, std::string>& read_from = {}) {
  std::string folder = parent.path() + "/" + name;
  make_folder(folder);
  Provenance provenance;
  provenance.sweeps = {{"a.json", ""}};
  provenance.sweep_name = "a";
  provenance.units = units;
  RunRecord run = sample_run(started);
  run.process = "node-7";
  std::vector<Row> rows = {{sample_job(outcome.job, 5), outcome}};
  rows[0].job.label = label;
  rows[0].job.files = read_from;
  write_tables(folder, provenance, rows, analyse(rows));
  ShardFiles files(folder, {}, run);
  files.add(outcome);
  files.flush();
  return folder;
}

TEST_CASE("two folders that differ in a packing are told, and the first one's is kept") {
  const TemporaryFolder parent;
  const Outcome first = sample_outcome("a1", 0.6, 6);
  Outcome other_bits = first, other_end = first;
  other_bits.result.state_hash ^= 1;
  other_bits.version = "9.9";
  other_end.result.status = PackingStatus::not_settled;
  for (const Outcome& other : {other_bits, other_end}) {
    const std::string out = parent.path() + "/all-" + name_of(other.result.status);
    const CollectOptions options{
        {folder_of_a_run(parent, "first", "1", first), folder_of_a_run(parent, "x", "2", other)},
        out};
    const Printed printed = printed_by([&] { CHECK(perform(options) == exit_done); });
    CHECK_THAT(printed.error,
               Contains("x: its packing a1 (version " + other.version + ") differs"));
    const Results all = read_results(out);
    REQUIRE(all.rows.size() == 1);
    CHECK(all.rows[0].outcome->result.state_hash == first.result.state_hash);
    CHECK(status_of(all.rows[0]) == "settled");
  }
}

TEST_CASE("folders that agree in a packing are collected without a word of warning") {
  const TemporaryFolder parent;
  Outcome outcome = sample_outcome("a1", 0.6, 6);
  outcome.version = program_version();
  const CollectOptions options{{folder_of_a_run(parent, "first", "1", outcome),
                                folder_of_a_run(parent, "second", "2", outcome)},
                               parent.path() + "/all"};
  CHECK(printed_by([&] { perform(options); }).error.empty());
}

/// Stores the outcome again, with a bed of so many grains.
void store_with_bed(const std::string& folder, Outcome& outcome, const Shard& shard = {},
                    std::size_t grains = 1) {
  StoredBed bed;
  bed.job = outcome.job;
  bed.state_hash = outcome.result.state_hash;
  bed.grains.resize(grains);
  add_stored_bed(folder, bed, outcome, shard);
  add_outcomes(folder, {outcome}, shard);
}

TEST_CASE("a sound bed that is collected in the place of a damaged one of later date stays") {
  for (const Shard& shard : {Shard{}, Shard{2, 2}}) {
    const TemporaryFolder parent;
    Outcome sound = sample_outcome("a1", 0.6, 6), damaged = sound;
    damaged.finished_at = sound.finished_at + 60;
    const std::string source = folder_of_a_run(parent, "source", "1", sound);
    const std::string out = folder_of_a_run(parent, "out", "2", damaged);
    store_with_bed(source, sound);
    store_with_bed(out, damaged, shard);
    damage_bed(out, damaged, 30);
    const auto collect = [&] {
      return printed_by([&] { perform(CollectOptions{{source}, out}); });
    };
    const Printed mending = collect();
    CHECK_THAT(mending.error, Contains(name_of(shard) + ".beds: packing a1: damaged"));
    CHECK_THAT(mending.out, Contains("1 packing added to " + out + ", which now holds 1 of 1"));
    Results all = read_results(out);
    CHECK(check_beds(out, all.rows).empty());
    CHECK(status_of(all.rows[0]) == "settled");
    CHECK_THAT(collect().out, Contains("0 packings added"));
  }
}

TEST_CASE("a bed that cannot be read is left out, and the exit code tells") {
  const TemporaryFolder parent;
  Outcome outcome = sample_outcome("a1", 0.6, 6);
  const std::string source = folder_of_a_run(parent, "source", "1", outcome);
  store_with_bed(source, outcome);
  damage_bed(source, outcome, 30);
  const Printed printed = printed_by([&] {
    CHECK(perform(CollectOptions{{source}, parent.path() + "/all"}) == exit_file_system);
  });
  CHECK_THAT(printed.error, Contains("left out"));
}

TEST_CASE("files of one name that hold different things are told apart") {
  const TemporaryFolder parent;
  const auto folder_with = [&](const std::string& name, const std::string& content) {
    Outcome outcome = sample_outcome(name, 0.6, 6);
    std::string folder = folder_of_a_run(parent, name, name, outcome);
    std::vector<Row> rows = {{sample_job(name, 5), outcome}};
    rows[0].job.parameters = R"({"shape":{"hull":{"vertices":")" + content + R"("}}})";
    rows[0].job.files["shape.hull.vertices"] = "rock.obj";
    Provenance provenance;
    provenance.sweep_name = "a";
    write_provenance(folder, provenance, rows);
    return folder;
  };
  const CollectOptions options{
      {folder_with("a1", "one"), folder_with("a2", "other"), folder_with("a3", "one")},
      parent.path() + "/all"};
  printed_by([&] { perform(options); });
  const std::vector<Row> rows = read_results(options.out).rows;
  REQUIRE(rows.size() == 3);
  const auto file_of = [](const Row& row) { return row.job.files.at("shape.hull.vertices"); };
  CHECK(file_of(rows[0]) == "rock.obj");
  CHECK_THAT(file_of(rows[1]), Catch::Matches("rock.obj [0-9a-f]{8}"));
  CHECK(file_of(rows[2]) == "rock.obj");
}

TEST_CASE("of two copies of a bed the one with grains is kept, in either order") {
  for (const bool grains_come_first : {true, false}) {
    const TemporaryFolder parent;
    Outcome with = sample_outcome("a1", 0.6, 6), without = with;
    const std::string full = folder_of_a_run(parent, "full", "1", with);
    const std::string bare = folder_of_a_run(parent, "bare", "2", without);
    store_with_bed(full, with);
    store_with_bed(bare, without, {}, 0);
    const std::string out = parent.path() + "/all";
    const auto folders = grains_come_first ? std::vector{full, bare} : std::vector{bare, full};
    printed_by([&] { perform(CollectOptions{folders, out}); });
    const Results all = read_results(out);
    REQUIRE(all.rows.size() == 1);
    CHECK(read_bed(out, *all.rows[0].outcome).grains.size() == 1);
  }
}

TEST_CASE("what a folder holds of another form of its sweep is kept, once") {
  const TemporaryFolder parent;
  Outcome earlier = sample_outcome("b2", 0.6, 6);
  const std::string source = folder_of_a_run(parent, "source", "1", sample_outcome("a1", 0.6, 6));
  store_with_bed(source, earlier);
  const std::string out = parent.path() + "/all";
  const auto collect = [&] {
    return printed_by([&] { perform(CollectOptions{{source}, out}); }).error;
  };
  CHECK_THAT(collect(), Contains("source: 1 packing of another form of its sweep: kept"));
  CHECK_THAT(collect(), !Contains("another form"));
  const Results all = read_results(out);
  CHECK(all.rows.size() == 1);
  CHECK(all.orphaned == 1);
  const JournalReading stored = read_journals(out, Detail::whole);
  REQUIRE(stored.outcomes.contains("b2"));
  CHECK(read_bed(out, *stored.outcomes.at("b2")).grains.size() == 1);
}

TEST_CASE("with --current nothing is kept of another form of a sweep, unless it is asked for") {
  const TemporaryFolder parent;
  const std::string source = folder_of_a_run(parent, "source", "1", sample_outcome("a1", 0.6, 6));
  Outcome earlier = sample_outcome("b2", 0.6, 6);
  store_with_bed(source, earlier);
  const std::string out = parent.path() + "/all";
  const Printed printed = printed_by([&] { perform(CollectOptions{{source}, out, true}); });
  CHECK_THAT(printed.error, Contains("source: 1 packing of another form of its sweep left out"));
  CHECK(read_results(out).rows.size() == 1);
  CHECK(read_results(out).orphaned == 0);
}

TEST_CASE("units are collected where the folders agree in them") {
  const TemporaryFolder parent;
  Outcome outcome = sample_outcome("a1", 0.6, 6);
  outcome.version = program_version();
  const Units units{3.2, "mm", std::nullopt};
  const std::string first = folder_of_a_run(parent, "first", "1", outcome, units);
  const std::string same = folder_of_a_run(parent, "same", "2", outcome, units);
  const std::string none = folder_of_a_run(parent, "none", "3", outcome);
  const std::string out = parent.path() + "/all";
  CHECK(printed_by([&] { perform(CollectOptions{{first, same}, out}); }).error.empty());
  CHECK(read_results(out).provenance.units == units);
  CHECK_THAT(printed_by([&] {
               perform(CollectOptions{{none}, out});
             }).error,
             Contains("none: has other units than the sweeps before it; the tables have none"));
  CHECK_FALSE(read_results(out).provenance.units);
  const std::string turned = parent.path() + "/turned";
  CHECK_THAT(printed_by([&] {
               perform(CollectOptions{{none, first}, turned});
             }).error,
             Contains("first: has other units than the sweeps before it; the tables have none"));
}

TEST_CASE("packings of equal parameters are collected under one label, and so are one group") {
  const TemporaryFolder parent;
  const std::string first = folder_of_a_run(parent, "first", "1", sample_outcome("a1", 0.6, 6));
  const std::string renamed =
      folder_of_a_run(parent, "renamed", "2", sample_outcome("a2", 0.6, 6), {}, "narrow");
  const std::string out = parent.path() + "/all";
  const Printed printed = printed_by([&] { perform(CollectOptions{{first, renamed}, out}); });
  CHECK_THAT(printed.error, Contains("renamed: packings called \"narrow\" have the parameters of "
                                     "\"MSP\" collected before, and are called so, too"));
  const Results all = read_results(out);
  REQUIRE(all.rows.size() == 2);
  CHECK(all.rows[1].job.label == "MSP");
  CHECK(groups_of(all.rows).size() == 1);
}

TEST_CASE("a given start that is packed with another seed is the same bed, and is kept once") {
  const TemporaryFolder parent;
  const std::map<std::string, std::string> start = {{"fill.files", "a.csv"}};
  Outcome other = sample_outcome("b1", 0.61, 6);
  other.result.state_hash = 77;
  const auto folder = [&](const std::string& name, const Outcome& outcome) {
    return folder_of_a_run(parent, name, name, outcome, {}, "MSP", start);
  };
  const std::string first = folder("1", sample_outcome("a1", 0.6, 6));
  const std::string same = folder("2", sample_outcome("a2", 0.6, 6)), next = folder("3", other);
  const std::string out = parent.path() + "/all";
  for (int k = 0; k < 2; ++k) {  // and again
    const Printed printed = printed_by([&] { perform(CollectOptions{{first, same, next}, out}); });
    CHECK_THAT(printed.error, Contains("2: 1 packing of a given start that is collected already"));
    CHECK(read_results(out).rows.size() == 2);
  }
}

TEST_CASE("a given start whose bed cannot be read is collected from where it can be") {
  const TemporaryFolder parent;
  const std::map<std::string, std::string> start = {{"fill.files", "a.csv"}};
  Outcome lost = sample_outcome("a1", 0.6, 6);
  const std::string first = folder_of_a_run(parent, "1", "1", lost, {}, "MSP", start);
  store_with_bed(first, lost);
  damage_bed(first, lost, 30);
  const std::string same =
      folder_of_a_run(parent, "2", "2", sample_outcome("a2", 0.6, 6), {}, "MSP", start);
  const std::string out = parent.path() + "/all";
  const Printed printed = printed_by([&] { perform(CollectOptions{{first, same}, out}); });
  CHECK_THAT(printed.error, !Contains("is kept once"));
  const Results all = read_results(out);
  REQUIRE(all.rows.size() == 2);
  CHECK_FALSE(is_made(all.rows[0]));
  CHECK(is_made(all.rows[1]));
}

// A host gives the number of a process again.
TEST_CASE("runs of one process name that began at different times are different runs") {
  const TemporaryFolder parent;
  const std::string monday =
      folder_of_a_run(parent, "monday", "2026-01-05T08:00:00Z", sample_outcome("a1", 0.6, 6));
  const std::string friday =
      folder_of_a_run(parent, "friday", "2026-01-09T08:00:00Z", sample_outcome("a2", 0.6, 6));
  const std::string out = parent.path() + "/all";
  printed_by([&] { perform(CollectOptions{{monday, friday, monday}, out}); });
  const std::vector<RunRecord> runs = read_results(out).provenance.runs;
  REQUIRE(runs.size() == 2);
  CHECK(runs[0].started == "2026-01-05T08:00:00Z");
  CHECK(runs[1].started == "2026-01-09T08:00:00Z");
}

}  // namespace
}  // namespace grainsweep
