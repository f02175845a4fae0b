#include <catch2/catch.hpp>

#include "runner/store/brief.hpp"
#include "runner/store/files.hpp"
#include "runner/store/journal.hpp"
#include "tests/runner/sample_rows.hpp"
#include "tests/runner/temporary_folder.hpp"

namespace grainsweep {
namespace {

std::string_view without_line_feed(std::string_view line) {
  return line.substr(0, line.size() - 1);
}

void check_equal(const Brief& brief, const Outcome& outcome) {
  CHECK(brief.job == outcome.job);
  CHECK(brief.version == outcome.version);
  CHECK(brief.status == outcome.result.status);
  CHECK(brief.threw == outcome.threw);
  CHECK(brief.cpu_seconds == outcome.cpu_seconds);
}

TEST_CASE("brief facts are those of the whole line, of this version or another") {
  for (const auto status :
       {PackingStatus::settled, PackingStatus::not_settled, PackingStatus::failed}) {
    for (const bool threw : {false, true}) {
      Outcome outcome = sample_outcome("0123456789abcdef", 0.6, 6.0);
      outcome.version = "1.2.3";
      outcome.result.status = status;
      outcome.threw = threw;
      outcome.cpu_seconds = 0.1 + 1e-17;
      const std::string line = journal_line(outcome);
      for (const char* version : {"1.2.3", "1.2.4"}) {
        const auto brief = read_brief(without_line_feed(line), version);
        REQUIRE(brief);
        check_equal(*brief, outcome);
      }
    }
  }
}

TEST_CASE("a reason that looks like members misleads nobody") {
  Outcome outcome = sample_outcome("a", 0.6, 6.0);
  outcome.version = "1";
  outcome.result.status = PackingStatus::failed;
  outcome.result.reason =
      R"("status":"settled","threw":true,"version":"2","job":"b","cpu_seconds":9,)";
  const auto brief = read_brief(without_line_feed(journal_line(outcome)), "1");
  REQUIRE(brief);
  check_equal(*brief, outcome);
}

TEST_CASE("a damaged line has no brief facts") {
  const std::string line = journal_line(sample_outcome("a", 0.6, 6.0));
  for (std::size_t at = 0; at + 1 < line.size(); ++at) {
    std::string damaged = line.substr(0, line.size() - 1);
    damaged[at] = static_cast<char>(damaged[at] ^ 1);
    CHECK_FALSE(read_brief(damaged, ""));
  }
}

TEST_CASE("journals in brief have the rules of whole journals") {
  const TemporaryFolder folder;
  Outcome first = sample_outcome("a", 0.6, 6.0), again = first, thrown = first, alone = first;
  again.cpu_seconds = 2.0;
  thrown.threw = alone.threw = true;
  alone.job = "b";
  std::string text = "torn\n";
  for (const Outcome& outcome : {first, alone, again, thrown}) text += journal_line(outcome);
  replace_file(folder.path() + "/journal-x-1.jsonl", text);
  const JournalReading whole = read_journals(folder.path());
  const BriefReading brief = read_briefs(folder.path(), "");
  CHECK(brief.damage == whole.damage);
  REQUIRE(brief.damage.size() == 1);
  REQUIRE(brief.briefs.size() == 2);
  for (const auto& [job, outcome] : whole.outcomes) check_equal(brief.briefs.at(job), outcome);
  CHECK(brief.briefs.at("a").cpu_seconds == 2.0);
}

}  // namespace
}  // namespace grainsweep
