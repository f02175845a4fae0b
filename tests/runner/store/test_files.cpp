#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <filesystem>
#include <string>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <sys/resource.h>
#include <sys/stat.h>

#include "runner/machine.hpp"
#include "runner/store/files.hpp"
#include "tests/runner/temporary_folder.hpp"

namespace grainsweep {
namespace {

using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

TEST_CASE("a pipe is neither read nor written, and nobody waits at it") {
  const TemporaryFolder folder;
  const std::string path = folder.path() + "/pipe";
  REQUIRE(mkfifo(path.c_str(), 0600) == 0);
  for (const int flags : {O_RDONLY, O_WRONLY, O_WRONLY | O_APPEND | O_CREAT, O_RDWR}) {
    CHECK_THROWS_WITH(OpenFile(path, flags),
                      Catch::Equals(path + ": is a pipe or a device, not a file"));
  }
}

TEST_CASE("a replaced file reads back byte by byte and leaves no neighbour behind") {
  const TemporaryFolder folder;
  const std::string path = folder.path() + "/a.bin";
  std::string bytes(300000, '\0');
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<char>(i * 31 % 251);
  replace_file(path, "old");
  replace_file(path, bytes);
  CHECK(read_file(path) == bytes);
  CHECK(files_in(folder.path(), "", "") == std::vector<std::string>{"a.bin"});
}

TEST_CASE("a part of a file is as long as asked for, or what is there of it") {
  const TemporaryFolder folder;
  const std::string path = folder.path() + "/a.bin", bytes = std::string(100'000, 'x') + "y";
  replace_file(path, bytes);
  for (const std::size_t size : {0, 1, 65'536, 65'537, 100'000, 100'001, 200'000}) {
    CHECK(read_part(path, 0, size) == bytes.substr(0, size));
    CHECK(read_part(path, 70'000, size) == bytes.substr(70'000, size));
    CHECK(read_part(path, 200'000, size).empty());
  }
}

TEST_CASE("a file error names the path and the cause") {
  const TemporaryFolder folder;
  const std::string missing = folder.path() + "/none/a.csv";
  CHECK_THROWS_WITH(read_file(missing),
                    StartsWith(missing) && Contains("No such file or directory"));
  CHECK_THROWS_WITH(replace_file(missing, "x"),
                    StartsWith(missing) && Contains("No such file or directory"));
}

TEST_CASE("what ended processes of this machine left is removed, and that of others kept") {
  const TemporaryFolder folder;
  const std::string other = "b.csv.tmp.another-machine-7-" + std::to_string(getpid());
  const std::string at_work = "a.csv.tmp." + process_name();
  // Numbers of processes are smaller.
  const std::string ended = "a.csv.tmp." + host_name() + "-7-999999999";
  const std::string just_written = "c.csv.tmp." + host_name() + "-7-999999999";
  for (const std::string& name : {other, at_work, ended, just_written}) {
    const std::string path = folder.path() + "/" + name;
    replace_file(path, "x");
    const auto now = std::filesystem::last_write_time(path);
    std::filesystem::last_write_time(path, now - std::chrono::hours(name == just_written ? 0 : 1));
  }
  remove_leftovers_of_ended(folder.path());
  CHECK(files_in(folder.path(), "", "") == std::vector<std::string>{at_work, other, just_written});
  remove_leftovers_of_ended(folder.path() + "/none");
}

TEST_CASE("a full disk is reported with path and cause") {
  const OpenFile full("/dev/full", O_WRONLY);
  CHECK_THROWS_WITH(write_all(full, "x"),
                    Catch::Equals("/dev/full: cannot write: No space left on device"));
}

/// While it lives no file of this process grows beyond `bytes`; what would is told by an error.
class LargestFile {
 public:
  explicit LargestFile(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  LargestFile(const LargestFile&) = delete;
  LargestFile& operator=(const LargestFile&) = delete;
  ~LargestFile() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit before_{};
  void (*handler_)(int);
};

// At the limit the system writes less than it is asked to, and calls that success.
TEST_CASE("a file is written to its end or told, never cut in silence") {
  const TemporaryFolder folder;
  const std::string path = folder.path() + "/a.csv", bytes(3000, 'x');
  replace_file(path, "old");
  std::string said;
  {
    const LargestFile limit(1000);
    try {
      replace_file(path, bytes);
    } catch (const FileError& error) {
      said = error.what();
    }
  }
  CHECK_THAT(said, StartsWith(path) && Contains("cannot write: File too large"));
  CHECK(read_file(path) == "old");
  replace_file(path, bytes);
  CHECK(read_file(path) == bytes);
}

TEST_CASE("a folder that cannot replace a file keeps the old file and no rest of the new one") {
  const TemporaryFolder folder;
  const std::string path = folder.path() + "/taken";
  make_folder(path + "/inside");  // a folder with content cannot be replaced by a file
  CHECK_THROWS_AS(replace_file(path, "x"), FileError);
  CHECK(files_in(folder.path(), "", "") == std::vector<std::string>{"taken"});
}

TEST_CASE("a file that is written bit by bit is seen once it is committed, or never") {
  const TemporaryFolder folder;
  const std::string path = folder.path() + "/a.csv", part(700'000, 'x');
  replace_file(path, "old");
  {
    Replacement left_alone(path);
    left_alone.write(part);
    left_alone.write(part);
  }
  CHECK(read_file(path) == "old");
  CHECK(files_in(folder.path(), "", "") == std::vector<std::string>{"a.csv"});
  Replacement file(path);
  for (const char* const end : {"1", "2", "3"}) file.write(part + end);
  CHECK(read_file(path) == "old");
  file.commit();
  CHECK(read_file(path) == part + "1" + part + "2" + part + "3");
  CHECK(files_in(folder.path(), "", "") == std::vector<std::string>{"a.csv"});
}

TEST_CASE("a folder is made with those above it, and making it again changes nothing") {
  const TemporaryFolder folder;
  make_folder(folder.path() + "/a/b/c");
  make_folder(folder.path() + "/a/b/c");
  CHECK(std::filesystem::is_directory(folder.path() + "/a/b/c"));
  replace_file(folder.path() + "/file", "x");
  CHECK_THROWS_AS(make_folder(folder.path() + "/file"), FileError);
  CHECK_THROWS_AS(make_folder(folder.path() + "/file/below"), FileError);
}

TEST_CASE("files are listed by start and end, sorted, and a missing folder has none") {
  const TemporaryFolder folder;
  for (const char* name : {"journal-b.jsonl", "journal-a.jsonl", "journal-c.txt", "x.jsonl"}) {
    replace_file(folder.path() + "/" + name, "");
  }
  CHECK(files_in(folder.path(), "journal-", ".jsonl") ==
        std::vector<std::string>{"journal-a.jsonl", "journal-b.jsonl"});
  CHECK(files_in(folder.path() + "/none", "", "").empty());
}

TEST_CASE("removing a file that is not there is no error") {
  const TemporaryFolder folder;
  replace_file(folder.path() + "/a", "x");
  remove_file(folder.path() + "/a");
  CHECK_FALSE(file_exists(folder.path() + "/a"));
  remove_file(folder.path() + "/a");
}

TEST_CASE("what a killed runner left half written is removed, and nothing else") {
  const TemporaryFolder folder;
  for (const char* name : {"a.csv", "a.csv.tmp.12", "b.csv.tmp.node-7.example-345", "b.csv.tmp.",
                           "c.csv.tmp.1x", "d.txt.tmp.12", "a.csv.tmp.12.bak"}) {
    replace_file(folder.path() + "/" + name, "x");
  }
  remove_leftovers(folder.path(), ".csv");
  CHECK(files_in(folder.path(), "", "") == std::vector<std::string>{"a.csv", "a.csv.tmp.12.bak",
                                                                    "b.csv.tmp.", "c.csv.tmp.1x",
                                                                    "d.txt.tmp.12"});
  remove_leftovers(folder.path() + "/none", ".csv");
}

}  // namespace
}  // namespace grainsweep
