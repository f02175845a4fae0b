#include <atomic>
#include <thread>

#include <catch2/catch.hpp>

#include "runner/machine.hpp"
#include "runner/store/lock.hpp"
#include "tests/runner/temporary_folder.hpp"

namespace grainsweep {
namespace {

// flock(2) belongs to the open file, so a second FileLock in one process stands for another one.
TEST_CASE("a lock is held by one, and free again once that is gone") {
  const TemporaryFolder folder;
  const std::string path = folder.path() + "/a";
  CHECK_FALSE(is_locked(path));
  {
    const FileLock first(path);
    REQUIRE(first.is_held());
    CHECK(is_locked(path));
    const FileLock second(path);
    CHECK_FALSE(second.is_held());
    CHECK(second.is_taken());
  }
  CHECK_FALSE(is_locked(path));
  CHECK(FileLock(path).is_held());
}

TEST_CASE("looking at the lock keeps no runner out") {
  const TemporaryFolder folder;
  const std::string path = folder.path() + "/a";
  { const FileLock earlier(path); }  // leaves the file to look at
  std::atomic<bool> is_over{false};
  std::thread looks([&] {
    while (!is_over) is_locked(path);
  });
  int refused = 0;
  for (int start = 0; start < 100; ++start) refused += FileLock(path).is_held() ? 0 : 1;
  is_over = true;
  looks.join();
  CHECK(refused == 0);
}

TEST_CASE("a process name can stand in a file name") {
  CHECK_THAT(process_name(), Catch::Matches("[A-Za-z0-9._-]+-[0-9]+"));
}

}  // namespace
}  // namespace grainsweep
