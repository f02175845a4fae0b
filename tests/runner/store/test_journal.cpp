#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "runner/hash.hpp"
#include "runner/store/files.hpp"
#include "runner/store/journal.hpp"
#include "runner/store/outcome_text.hpp"
#include "tests/runner/sample_rows.hpp"
#include "tests/runner/stored.hpp"
#include "tests/runner/temporary_folder.hpp"

namespace grainsweep {
namespace {

std::uint64_t bits(double value) { return std::bit_cast<std::uint64_t>(value); }

/// The line that holds it, without its line feed.
std::string bare_line(const Outcome& outcome) {
  std::string line = journal_line(outcome);
  line.pop_back();
  return line;
}

Outcome read_back(std::string_view line, Detail detail = Detail::whole) {
  const auto outcome = read_journal_line(line, detail);
  REQUIRE(outcome);
  return *outcome;
}

std::string first_journal(const TemporaryFolder& folder) {
  make_folder(shards_folder(folder.path()));
  return journal_path(folder.path(), "1-of-1");
}

TEST_CASE("an outcome read from its journal line is the same in every member") {
  Outcome outcome = sample_outcome("00c0ffee00c0ffee", 0.1 + 0.2, 1.0 / 3.0);
  outcome.result.reason = "no \"room\", φ\nsecond line";
  outcome.result.state_hash = std::numeric_limits<std::uint64_t>::max();
  outcome.stored_at = 5'000'000'000;
  outcome.stored_bytes = 17;
  outcome.finished_at = 1767225600.125;
  outcome.version = "1.2.3";
  const Outcome back = read_back(bare_line(outcome));
  CHECK(outcome_text(back) == outcome_text(outcome));
  CHECK(back.result.reason == outcome.result.reason);
  CHECK(back.result.state_hash == outcome.result.state_hash);
  CHECK(back.stored_at == 5'000'000'000);
  CHECK(back.stored_bytes == 17);
  CHECK(back.finished_at == 1767225600.125);
  CHECK(back.version == "1.2.3");
}

TEST_CASE("how shapes touch and point reads back, spheres have no member for it") {
  Outcome outcome = *polyhedra_row("a", 5).outcome;
  outcome.result.shape_order->force_share[2] = 1.0 / 3.0;
  outcome.result.shape_order->nematic[1] = std::numeric_limits<double>::quiet_NaN();
  const Outcome back = read_back(bare_line(outcome));
  CHECK(outcome_text(back) == outcome_text(outcome));
  REQUIRE(back.result.shape_order);
  CHECK(bits(back.result.shape_order->force_share[2]) == bits(1.0 / 3.0));
  CHECK(std::isnan(back.result.shape_order->nematic[1]));
  CHECK(outcome_text(sample_outcome("a", 0.6, 6.0)).find("nematic") == std::string::npos);
}

TEST_CASE("doubles of every kind read back with the same bits") {
  const double infinite = std::numeric_limits<double>::infinity();
  for (const double value :
       {0.0, -0.0, 0.1, 1.0 / 3.0, 5e-324, 2.2250738585072011e-308, 1e-5, std::nextafter(0.64, 1.0),
        1.7976931348623157e308, 123456789012345680.0, infinite, -infinite,
        std::numeric_limits<double>::quiet_NaN()}) {
    Outcome outcome = sample_outcome("a", value, value);
    outcome.result.rest.step_residual = value;
    outcome.cpu_seconds = value;
    const Outcome back = read_back(bare_line(outcome));
    CHECK(bits(back.result.solid_fraction) == bits(value));
    CHECK(bits(back.result.rest.step_residual) == bits(value));
    CHECK(bits(back.result.coordination.at(0).between_grains) == bits(value));
    CHECK(bits(back.cpu_seconds) == bits(value));
  }
}

TEST_CASE("a journal line is valid JSON by itself") {
  const auto line = nlohmann::json::parse(journal_line(sample_outcome("a", 0.6, 6.0)));
  CHECK(line.at("outcome").at("job") == "a");
  CHECK(line.at("length") == line.at("outcome").dump().size());
}

TEST_CASE("a summary is the beginning of the whole") {
  Outcome outcome = sample_outcome("a", 0.6, 6.0);
  outcome.version = "1.2.3";
  std::string line = bare_line(outcome);
  const Outcome summary = read_back(line, Detail::summary);
  CHECK(summary.job == "a");
  CHECK(summary.version == "1.2.3");
  CHECK(summary.result.status == PackingStatus::settled);
  CHECK(summary.cpu_seconds == 0.75);
  CHECK(summary.result.grains == 0);
  line[line.find("2000")] = '3';  // behind the summary
  CHECK_FALSE(read_journal_line(line, Detail::summary));
}

/// A line with this text of an outcome.
std::string line_of(const std::string& text) {
  return R"({"length":)" + std::to_string(text.size()) + R"(,"crc32":")" + hex8(crc32(text)) +
         R"(","outcome":)" + text + "}";
}

TEST_CASE("a whole line with other members than ours is of another version, and dropped") {
  const std::string text = outcome_text(sample_outcome("a", 0.6, 6.0));
  CHECK(read_journal_line(line_of(text)));
  const std::string with_more = text.substr(0, text.size() - 1) + R"(,"viscosity":1.5})";
  CHECK_FALSE(read_journal_line(line_of(with_more)));
  std::string with_less = text;
  with_less.replace(text.find(R"("grains":2000,)"), 14, "");
  CHECK_FALSE(read_journal_line(line_of(with_less)));
  std::string of_another_kind = text;
  of_another_kind.replace(text.find("2000"), 4, R"("2k")");
  CHECK_FALSE(read_journal_line(line_of(of_another_kind)));
  std::string with_half_a_coordination = text;
  with_half_a_coordination.replace(text.find("\"coordinations\":[") + 17, 0, "0.5,");
  CHECK_FALSE(read_journal_line(line_of(with_half_a_coordination)));
  CHECK_FALSE(read_journal_line(line_of("[1,2]")));
  CHECK_FALSE(read_journal_line(line_of("{\"job\":")));
}

TEST_CASE("a number that earlier versions did not measure is missing, and the rest is read") {
  Outcome outcome = sample_outcome("a", 0.6, 6);
  const std::string before = outcome_text(outcome);
  outcome.result.small_share_of_bed = 0.25;
  const std::string now = outcome_text(outcome);
  CHECK(now.find("\"bed_small_share\":0.25") != std::string::npos);
  const auto old = outcome_from_text(before, Detail::whole);
  REQUIRE(old);
  CHECK_FALSE(old->result.small_share_of_bed);
  CHECK(outcome_from_text(now, Detail::whole)->result.small_share_of_bed == 0.25);
}

TEST_CASE("of two outcomes of a job the one that was finished later counts, in whatever journal") {
  const TemporaryFolder folder;
  Outcome earlier = sample_outcome("a", 0.60, 6.0), later = sample_outcome("a", 0.62, 6.0);
  earlier.finished_at = 1000.0;
  later.finished_at = 1000.5;
  add_outcomes(folder.path(), {earlier, sample_outcome("b", 0.61, 6.0), later});
  add_outcomes(folder.path(), {earlier}, {2, 3});
  const JournalReading reading = read_journals(folder.path());
  CHECK(reading.damage.empty());
  REQUIRE(reading.outcomes.size() == 2);
  CHECK(reading.outcomes.at("a")->result.solid_fraction == 0.62);
  CHECK(reading.outcomes.at("a")->shard == "1-of-1");
}

TEST_CASE(
    "of two lines of one journal the later counts, though the clock was set back between them") {
  Outcome first = sample_outcome("a", 0.60, 6.0), remade = sample_outcome("a", 0.62, 6.0),
          of_another = sample_outcome("a", 0.64, 6.0);
  first.finished_at = 3000.0;
  remade.finished_at = 1000.0;
  of_another.finished_at = 2000.0;
  const TemporaryFolder alone;
  add_outcomes(alone.path(), {first, remade});
  CHECK(read_journals(alone.path()).outcomes.at("a")->result.solid_fraction == 0.62);
  for (const int number : {1, 2}) {  // what counts does not depend on which is read first
    const TemporaryFolder folder;
    add_outcomes(folder.path(), {first, remade}, {number, 2});
    add_outcomes(folder.path(), {of_another}, {3 - number, 2});
    CHECK(read_journals(folder.path()).outcomes.at("a")->result.solid_fraction == 0.64);
  }
}

TEST_CASE("an exception never replaces a result, but a result replaces an exception") {
  const TemporaryFolder folder;
  Outcome failed;
  failed.job = "a";
  failed.exception = true;
  failed.finished_at = 2000.0;
  add_outcomes(folder.path(), {failed});
  CHECK(read_journals(folder.path()).outcomes.at("a")->exception);
  add_outcomes(folder.path(), {sample_outcome("a", 0.60, 6.0), failed});
  CHECK_FALSE(read_journals(folder.path()).outcomes.at("a")->exception);
}

TEST_CASE("a run is told by its last line, and one that made nothing is not listed") {
  const TemporaryFolder folder;
  RunRecord made = sample_run("2026-01-02"), killed = sample_run("2026-01-01"),
            idle = sample_run("2026-01-03");
  const std::string begun = journal_line(made);
  made.packings = 3;
  made.ended = idle.ended = "2026-01-04";
  made.command = "grainsweep run \xff";  // no UTF-8
  replace_file(first_journal(folder),
               journal_line(killed) + begun + journal_line(made) + journal_line(idle));
  const JournalReading reading = read_journals(folder.path());
  CHECK(reading.damage.empty());
  REQUIRE(reading.runs.size() == 2);
  CHECK(reading.runs[0].started == "2026-01-01");
  CHECK(reading.runs[1].packings == 3);
  CHECK(last_run_in(first_journal(folder))->started == "2026-01-03");
  CHECK_FALSE(read_run_line(R"({"length":2,"crc32":"a3d3c5f0","run":{}})"));
}

TEST_CASE("a line torn at any byte is dropped and reported, the lines before it are kept") {
  const std::string first = journal_line(sample_outcome("a", 0.60, 6.0));
  const std::string second = journal_line(sample_outcome("b", 0.61, 6.0));
  const TemporaryFolder folder;
  const std::string path = first_journal(folder);
  for (std::size_t kept = 1; kept < second.size() - 1; ++kept) {
    replace_file(path, first + second.substr(0, kept));
    const JournalReading reading = read_journals(folder.path());
    REQUIRE(reading.outcomes.size() == 1);
    REQUIRE(reading.damage.size() == 1);
    CHECK_THAT(reading.damage[0], Catch::Contains("/shards/1-of-1.jsonl:2: torn or damaged"));
    if (kept > 40) kept += 12;  // each file costs a flush; every thirteenth byte is enough there
  }
}

TEST_CASE("a changed byte anywhere in a line is noticed") {
  const std::string line = journal_line(sample_outcome("a", 0.60, 6.0));
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    std::string changed = line.substr(0, line.size() - 1);
    changed[i] = changed[i] == '7' ? '8' : '7';
    CHECK_FALSE(read_journal_line(changed));
  }
}

TEST_CASE("a whole line that is no outcome is dropped") {
  CHECK_FALSE(read_journal_line(R"({"length":2,"crc32":"a3d3c5f0","outcome":{}})"));
  CHECK_FALSE(read_journal_line(""));
  CHECK_FALSE(read_journal_line("}"));
}

TEST_CASE("a journal that was torn is continued on a new line") {
  const TemporaryFolder folder;
  add_outcomes(folder.path(), {sample_outcome("a", 0.60, 6.0)});
  const std::string path = first_journal(folder);
  replace_file(path, read_file(path) + R"({"length":10)");
  add_outcomes(folder.path(), {sample_outcome("b", 0.61, 6.0)});
  const JournalReading reading = read_journals(folder.path());
  CHECK(reading.outcomes.size() == 2);
  CHECK(reading.damage.size() == 1);
}

TEST_CASE("a torn line is told as left out, be it of a run or of a packing that is there again") {
  const TemporaryFolder folder;
  const std::string path = first_journal(folder);
  for (const std::string& line :
       {journal_line(sample_run()), journal_line(sample_outcome("a", 0.60, 6.0))}) {
    replace_file(path, line.substr(0, line.size() / 2) + "\n" + line);
    CHECK(read_journals(folder.path()).damage ==
          std::vector<std::string>{path + ":1: torn or damaged line, or one of another version, "
                                          "left out; run makes again what is missing"});
  }
}

TEST_CASE("a run tells the form of its sweep, one of an earlier version does not") {
  RunRecord run = sample_run();
  run.form = "00ff";
  const std::string line = journal_line(run);
  CHECK(read_run_line(std::string_view(line).substr(0, line.size() - 1))->form == "00ff");
  nlohmann::json earlier = run;
  earlier.erase("form");
  CHECK(earlier.get<RunRecord>().form.empty());
}

TEST_CASE("many lines that cannot be read are told in one, with their number") {
  const TemporaryFolder folder;
  const std::string path = first_journal(folder);
  replace_file(path, journal_line(sample_outcome("a", 0.6, 6.0)) + "torn\ntorn\ntorn");
  const JournalReading reading = read_journals(folder.path());
  CHECK(reading.unread == 3);
  CHECK(reading.damage ==
        std::vector<std::string>{path +
                                 ": 3 torn or damaged lines, or of another version, the first is "
                                 "line 2, left out; run makes again what is missing"});
  const FileLock at_work(path);  // the last one is just being written
  CHECK(read_journals(folder.path()).unread == 2);
}

TEST_CASE("a line that a runner is just writing is no damage") {
  const TemporaryFolder folder;
  const std::string path = first_journal(folder);
  replace_file(path, journal_line(sample_outcome("a", 0.6, 6.0)) + R"({"length":10)");
  const FileLock at_work(path);
  const JournalReading reading = read_journals(folder.path());
  CHECK(reading.outcomes.size() == 1);
  CHECK(reading.damage.empty());
}

TEST_CASE("journals of several shards are read together, beds without one are told") {
  const TemporaryFolder folder;
  add_outcomes(folder.path(), {sample_outcome("a", 0.6, 6.0)}, {1, 2});
  add_outcomes(folder.path(), {sample_outcome("b", 0.6, 6.0)}, {2, 2});
  replace_file(shards_folder(folder.path()) + "/notes.jsonl", "mine");
  CHECK(read_journals(folder.path()).outcomes.size() == 2);
  CHECK(read_journals(folder.path() + "/none").outcomes.empty());
  replace_file(beds_path(folder.path(), "7-of-9"), "beds");
  const auto damage = read_journals(folder.path()).damage;
  REQUIRE(damage.size() == 1);
  CHECK_THAT(damage[0],
             Catch::EndsWith("/shards/7-of-9.beds: left out, its journal is missing; run makes "
                             "again what is missing"));
}

}  // namespace
}  // namespace grainsweep
