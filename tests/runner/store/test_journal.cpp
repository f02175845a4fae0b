#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "runner/hash.hpp"
#include "runner/store/files.hpp"
#include "runner/store/journal.hpp"
#include "runner/store/outcome_text.hpp"
#include "tests/runner/sample_rows.hpp"
#include "tests/runner/temporary_folder.hpp"

namespace grainsweep {
namespace {

std::uint64_t bits(double value) { return std::bit_cast<std::uint64_t>(value); }

std::string journal_in(const TemporaryFolder& folder) {
  return folder.path() + "/" + files_in(folder.path(), "journal-", ".jsonl").at(0);
}

TEST_CASE("an outcome read from its journal line is the same in every member") {
  Outcome outcome = sample_outcome("00c0ffee00c0ffee", 0.1 + 0.2, 1.0 / 3.0);
  outcome.result.reason = "no \"room\", φ\nsecond line";
  outcome.result.state_hash = std::numeric_limits<std::uint64_t>::max();
  outcome.stored_bytes = 17;
  outcome.version = "1.2.3";
  const Outcome back =
      read_journal_line(journal_line(outcome).substr(0, journal_line(outcome).size() - 1)).value();
  CHECK(outcome_text(back) == outcome_text(outcome));
  CHECK(back.result.reason == outcome.result.reason);
  CHECK(back.result.state_hash == outcome.result.state_hash);
  CHECK(back.stored_bytes == 17);
  CHECK(back.version == "1.2.3");
}

TEST_CASE("how shapes touch and point reads back, spheres have no member for it") {
  Outcome outcome = *polyhedra_row("a", 5).outcome;
  outcome.result.shape_order->force_share[2] = 1.0 / 3.0;
  outcome.result.shape_order->nematic[1] = std::numeric_limits<double>::quiet_NaN();
  const std::string line = journal_line(outcome);
  const Outcome back = read_journal_line(std::string_view(line).substr(0, line.size() - 1)).value();
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
    const std::string line = journal_line(outcome);
    const Outcome back =
        read_journal_line(std::string_view(line).substr(0, line.size() - 1)).value();
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
  std::string line = journal_line(outcome);
  line.pop_back();
  const Outcome summary = read_journal_line(line, Detail::summary).value();
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
  CHECK_FALSE(read_journal_line(line_of("[1,2]")));
  CHECK_FALSE(read_journal_line(line_of("{\"job\":")));
}

TEST_CASE("appended outcomes are read back, the later one of a job counts") {
  const TemporaryFolder folder;
  Journal journal(folder.path());
  journal.append(sample_outcome("a", 0.60, 6.0));
  journal.append(sample_outcome("b", 0.61, 6.0));
  journal.append(sample_outcome("a", 0.62, 6.0));
  const JournalReading reading = read_journals(folder.path());
  CHECK(reading.damage.empty());
  REQUIRE(reading.outcomes.size() == 2);
  CHECK(reading.outcomes.at("a").result.solid_fraction == 0.62);
}

TEST_CASE("an exception never replaces a result, but a result replaces an exception") {
  const TemporaryFolder folder;
  Journal journal(folder.path());
  Outcome failed;
  failed.job = "a";
  failed.exception = true;
  journal.append(failed);
  CHECK(read_journals(folder.path()).outcomes.at("a").exception);
  journal.append(sample_outcome("a", 0.60, 6.0));
  journal.append(failed);
  CHECK_FALSE(read_journals(folder.path()).outcomes.at("a").exception);
}

TEST_CASE("a line torn at any byte is dropped and reported, the lines before it are kept") {
  const std::string first = journal_line(sample_outcome("a", 0.60, 6.0));
  const std::string second = journal_line(sample_outcome("b", 0.61, 6.0));
  const TemporaryFolder folder;
  const std::string path = folder.path() + "/journal-host-1.jsonl";
  for (std::size_t kept = 1; kept < second.size() - 1; ++kept) {
    replace_file(path, first + second.substr(0, kept));
    const JournalReading reading = read_journals(folder.path());
    REQUIRE(reading.outcomes.size() == 1);
    REQUIRE(reading.damage.size() == 1);
    CHECK_THAT(reading.damage[0], Catch::Contains("/journal-host-1.jsonl:2: torn or damaged"));
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
  Journal(folder.path()).append(sample_outcome("a", 0.60, 6.0));
  const std::string path = journal_in(folder);
  replace_file(path, read_file(path) + R"({"length":10)");
  Journal(folder.path()).append(sample_outcome("b", 0.61, 6.0));
  const JournalReading reading = read_journals(folder.path());
  CHECK(reading.outcomes.size() == 2);
  CHECK(reading.damage.size() == 1);
}

TEST_CASE("journals of several processes are read together") {
  const TemporaryFolder folder;
  replace_file(folder.path() + "/journal-x-1.jsonl", journal_line(sample_outcome("a", 0.6, 6.0)));
  replace_file(folder.path() + "/journal-y-2.jsonl", journal_line(sample_outcome("b", 0.6, 6.0)));
  CHECK(read_journals(folder.path()).outcomes.size() == 2);
  CHECK(read_journals(folder.path() + "/none").outcomes.empty());
}

}  // namespace
}  // namespace grainsweep
