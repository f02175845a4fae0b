#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "runner/store/shard_files.hpp"
#include "tests/runner/sample_rows.hpp"
#include "tests/runner/stored.hpp"
#include "tests/runner/temporary_folder.hpp"

namespace grainsweep {
namespace {

using Catch::Contains;

// A second ShardFiles in one process stands for another one, as of test_lock.cpp.
TEST_CASE("a second runner of a shard is refused and told who works on it") {
  const TemporaryFolder folder;
  const ShardFiles first(folder.path(), {2, 3}, sample_run());
  REQUIRE(first.is_locked());
  const std::string process = "host node, process " + std::to_string(getpid());
  CHECK_THROWS_AS(ShardFiles(folder.path(), {2, 3}, sample_run()), FolderBusy);
  CHECK_THROWS_WITH(ShardFiles(folder.path(), {2, 3}, sample_run()),
                    Contains(folder.path()) && Contains(process));
}

TEST_CASE("shards of one division work side by side, of two they would overlap") {
  const TemporaryFolder folder;
  const ShardFiles first(folder.path(), {2, 3}, sample_run());
  CHECK_NOTHROW(ShardFiles(folder.path(), {3, 3}, sample_run()));
  CHECK_THROWS_AS(ShardFiles(folder.path(), {1, 1}, sample_run()), FolderBusy);
  CHECK_THROWS_AS(ShardFiles(folder.path(), {2, 4}, sample_run()), FolderBusy);
}

TEST_CASE("the folder is free again once its runners are gone") {
  const TemporaryFolder folder;
  { const ShardFiles first(folder.path(), {2, 3}, sample_run()); }
  CHECK(ShardFiles(folder.path(), {}, sample_run()).is_locked());
}

TEST_CASE("nothing is in the files before it is brought to the disk") {
  const TemporaryFolder folder;
  ShardFiles files(folder.path(), {}, sample_run());
  files.add(sample_outcome("a", 0.6, 6.0));
  CHECK(read_journals(folder.path()).outcomes.empty());
  files.flush();
  CHECK(read_journals(folder.path()).outcomes.size() == 1);
}

TEST_CASE("beds stand one behind the other, also those of a later run") {
  const TemporaryFolder folder;
  std::vector<Outcome> outcomes;
  for (const char* job : {"a", "b", "c"}) outcomes.push_back(sample_outcome(job, 0.6, 6.0));
  {
    ShardFiles files(folder.path(), {}, sample_run());
    files.add_bed(bed_of(outcomes[0]), outcomes[0]);
    files.add_bed(bed_of(outcomes[1]), outcomes[1]);
    files.flush();
  }
  add_stored_bed(folder.path(), bed_of(outcomes[2]), outcomes[2]);
  for (const Outcome& outcome : outcomes)
    CHECK(read_bed(folder.path(), outcome).job == outcome.job);
  CHECK(outcomes[2].stored_at == 2 * outcomes[0].stored_bytes);
}

TEST_CASE("what is made anew counts more than what was known, by whatever clock, in any journal") {
  Outcome known = sample_outcome("a", 0.60, 6.0), remade = sample_outcome("a", 0.62, 6.0);
  known.finished_at = 2000.0;
  for (const double finished_at : {1000.0, 2000.0, 3000.0}) {
    const TemporaryFolder folder;
    add_outcomes(folder.path(), {known}, {2, 3});
    remade.finished_at = finished_at;
    ShardFiles files(folder.path(), {1, 3}, sample_run());
    files.count_after(known);
    Outcome earlier = known;
    earlier.finished_at -= 7.0;
    files.count_after(earlier);  // the latest one counts
    CHECK(files.add(remade).finished_at > known.finished_at);
    files.flush();
    const Outcome counts = *read_journals(folder.path()).outcomes.at("a");
    CHECK(counts.result.solid_fraction == 0.62);
    CHECK(counts.finished_at == std::max(finished_at, std::nextafter(2000.0, 3000.0)));
  }
}

TEST_CASE("a journal that was taken away is not made anew") {
  const TemporaryFolder folder;
  ShardFiles files(folder.path(), {}, sample_run());
  remove_file(journal_path(folder.path(), "1-of-1"));
  files.add(sample_outcome("a", 0.6, 6.0));
  CHECK_THROWS_AS(files.flush(), FileError);
}

TEST_CASE("a run that starts anew forgets what all shards have stored") {
  const TemporaryFolder folder;
  Outcome other = sample_outcome("b", 0.6, 6.0);
  add_outcomes(folder.path(), {sample_outcome("a", 0.6, 6.0)});
  add_stored_bed(folder.path(), bed_of(other), other, {2, 3});
  for (const char* name : {"2-of-2.beds", "notes.beds", "notes.txt"}) {
    replace_file(shards_folder(folder.path()) + "/" + name, "");
  }
  ShardFiles files(folder.path(), {}, sample_run());
  files.remove_all(sample_run());
  CHECK(read_journals(folder.path()).outcomes.empty());
  CHECK(last_run_in(journal_path(folder.path(), "1-of-1")));
  CHECK(files_in(shards_folder(folder.path()), "", "") ==
        std::vector<std::string>{"1-of-1.jsonl", "notes.beds", "notes.txt"});
  CHECK(read_journals(folder.path()).damage.empty());
}

}  // namespace
}  // namespace grainsweep
