#include <atomic>
#include <optional>
#include <thread>
#include <unistd.h>

#include <catch2/catch.hpp>

#include "runner/store/lock.hpp"
#include "tests/runner/temporary_folder.hpp"

namespace grainsweep {
namespace {

using Catch::Matchers::Contains;

// flock(2) belongs to the open file, so a second FolderLock in one process stands for another one.
TEST_CASE("a second runner is refused and told who works in the folder") {
  const TemporaryFolder folder;
  const FolderLock first(folder.path());
  REQUIRE(first.is_held());
  const std::string process = "process " + std::to_string(getpid());
  CHECK_THROWS_AS(FolderLock(folder.path()), FolderBusy);
  CHECK_THROWS_WITH(FolderLock(folder.path()), Contains(folder.path()) && Contains(process));
  CHECK_THAT(present_runner(folder.path()).value(), Contains(process));
}

TEST_CASE("the folder is free again once its runner is gone") {
  const TemporaryFolder folder;
  { const FolderLock first(folder.path()); }
  CHECK_FALSE(present_runner(folder.path()));
  CHECK(FolderLock(folder.path()).is_held());
}

TEST_CASE("the lock's file holds one line, whatever longer one was in it") {
  const TemporaryFolder folder;
  const std::string path = folder.path() + "/runner.lock";
  replace_file(path, "host with-a-very-long-name.somewhere.example, process 123456789\nmore\n");
  const FolderLock lock(folder.path());
  CHECK_THAT(read_file(path),
             Catch::Matches("host [^ ]+, process " + std::to_string(getpid()) + "\n"));
}

TEST_CASE("looking at the lock keeps no runner out") {
  const TemporaryFolder folder;
  { const FolderLock earlier(folder.path()); }  // leaves the file to look at
  std::atomic<bool> is_over{false};
  std::thread looks([&] {
    while (!is_over) present_runner(folder.path());
  });
  int refused = 0;
  for (int start = 0; start < 100; ++start) {
    try {
      const FolderLock lock(folder.path());
      refused += lock.is_held() ? 0 : 1;
    } catch (const FolderBusy&) {
      ++refused;
    }
  }
  is_over = true;
  looks.join();
  CHECK(refused == 0);
}

TEST_CASE("a folder that never had a runner has none at work") {
  const TemporaryFolder folder;
  CHECK_FALSE(present_runner(folder.path()));
}

TEST_CASE("a process name can stand in a file name") {
  CHECK_THAT(process_name(), Catch::Matches("[A-Za-z0-9._-]+-[0-9]+"));
}

}  // namespace
}  // namespace grainsweep
