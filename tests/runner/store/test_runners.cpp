#include <fcntl.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <sys/stat.h>
#include <sys/wait.h>

#include "runner/machine.hpp"
#include "runner/store/runners.hpp"
#include "runner/store/shard_files.hpp"
#include "tests/runner/stored.hpp"
#include "tests/runner/temporary_folder.hpp"

namespace grainsweep {
namespace {

RunRecord run_on(const std::string& host) {
  RunRecord run = sample_run();
  run.host = host;
  run.process = host + "-4711";
  run.ended.clear();
  return run;
}

std::vector<Runner> runners_now(const TemporaryFolder& folder) {
  return runners_in(folder.path(), read_journals(folder.path()).last_runs);
}

/// As if its runner had last said so many seconds ago that it is alive.
void age(const TemporaryFolder& folder, const std::string& shard, double seconds) {
  timespec then{};
  clock_gettime(CLOCK_REALTIME, &then);
  then.tv_sec -= static_cast<time_t>(seconds);
  const timespec times[2] = {then, then};
  utimensat(AT_FDCWD, journal_path(folder.path(), shard).c_str(), times, 0);
}

TEST_CASE("a runner that holds its lock is at work, however long it is silent") {
  const TemporaryFolder folder;
  const ShardFiles files(folder.path(), {2, 3}, run_on("n7"));
  age(folder, "2-of-3", 10 * lost_after_seconds);
  const std::vector<Runner> runners = runners_now(folder);
  REQUIRE(runners.size() == 1);
  CHECK_FALSE(runners[0].is_lost);
  CHECK(runners[0].shard == "2-of-3");
  CHECK(owner_text(runners[0].run) == "host n7, process 4711");
}

TEST_CASE("a runner of this machine without its lock is lost once its process has ended") {
  const TemporaryFolder folder;
  RunRecord run = run_on(host_name());
  run.process = host_name() + "-1-999999999";  // more than the system gives out
  { const ShardFiles files(folder.path(), {}, run); }
  REQUIRE(runners_now(folder).size() == 1);
  CHECK(runners_now(folder)[0].is_lost);
}

TEST_CASE("a process that nobody has waited for has ended all the same") {
  const pid_t child = fork();
  if (child == 0) _exit(0);
  REQUIRE(child > 0);
  siginfo_t facts{};
  REQUIRE(waitid(P_PID, static_cast<id_t>(child), &facts, WEXITED | WNOWAIT) == 0);
  const std::string name = host_name() + "-1-" + std::to_string(child);
  CHECK(has_ended(name));
  REQUIRE(waitpid(child, nullptr, 0) == child);
  CHECK(has_ended(name));
  CHECK_FALSE(has_ended(process_name()));
  CHECK_FALSE(has_ended("another-machine-1-999999999"));
  CHECK_FALSE(has_ended(host_name() + "-2-1-999999999"));  // the host "<this one>-2"
  CHECK_FALSE(has_ended("-999999999"));
}

TEST_CASE("a runner of this machine is at work where the file system knows no locks") {
  const TemporaryFolder folder;
  RunRecord run = run_on(host_name());
  run.process = process_name();
  { const ShardFiles files(folder.path(), {}, run); }
  REQUIRE(runners_now(folder).size() == 1);
  CHECK_FALSE(runners_now(folder)[0].is_lost);
  age(folder, "1-of-1", lost_after_seconds + 60.0);  // another process may have its number
  CHECK(runners_now(folder)[0].is_lost);
}

TEST_CASE("a runner of another machine is lost once it has long been silent") {
  const TemporaryFolder folder;
  { const ShardFiles files(folder.path(), {}, run_on("another-machine")); }
  REQUIRE(runners_now(folder).size() == 1);
  CHECK_FALSE(runners_now(folder)[0].is_lost);
  age(folder, "1-of-1", lost_after_seconds + 60.0);
  REQUIRE(runners_now(folder).size() == 1);
  CHECK(runners_now(folder)[0].is_lost);
  CHECK(runners_now(folder)[0].silent >= lost_after_seconds);
  CHECK(runners_at_work(folder.path()).empty());
  touch_journal(journal_path(folder.path(), "1-of-1"));
  CHECK(runners_at_work(folder.path()).size() == 1);
  CHECK_FALSE(runners_now(folder)[0].is_lost);
}

TEST_CASE("a runner that noted its end is neither at work nor lost") {
  const TemporaryFolder folder;
  {
    RunRecord run = run_on(host_name());
    ShardFiles files(folder.path(), {}, run);
    run.ended = "2026-01-01T00:00:00Z";
    files.add(run);
    files.flush();
  }
  CHECK(runners_now(folder).empty());
  CHECK(runners_in(folder.path() + "/none", {}).empty());
  CHECK(owner_text(std::nullopt) == "another process");
}

}  // namespace
}  // namespace grainsweep
