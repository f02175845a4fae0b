#include <string>

#include <catch2/catch.hpp>

#include "runner/store/checkpoints.hpp"
#include "runner/store/files.hpp"
#include "tests/runner/temporary_folder.hpp"

namespace grainsweep {
namespace {

const std::string job_id = "00c0ffee00c0ffee";

CheckpointFiles files_in_folder(const TemporaryFolder& folder, const std::string& build = "1.0") {
  return {folder.path(), job_id, build};
}

std::string path_of(const TemporaryFolder& folder, int slot) {
  return folder.path() + "/checkpoints/" + job_id + "." + std::to_string(slot);
}

/// Overwrites a file with other bytes.
void damage(const std::string& path) {
  std::string bytes = read_file(path);
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
  replace_file(path, bytes);
}

TEST_CASE("a checkpoint reads back byte by byte") {
  const NumberedCheckpoint written{
      7, job_id, "1.0-abcd", {12345, 0.1 + 0.2, std::string("a\0b\n\xff", 5)}};
  const auto back = checkpoint_from_bytes(checkpoint_bytes(written)).value();
  CHECK(back.number == 7);
  CHECK(back.job == job_id);
  CHECK(back.build == "1.0-abcd");
  CHECK(back.checkpoint.step == 12345);
  CHECK(back.checkpoint.cpu_seconds == 0.1 + 0.2);
  CHECK(back.checkpoint.state == written.checkpoint.state);
  CHECK(checkpoint_from_bytes(checkpoint_bytes({})));
}

TEST_CASE("a cut or changed checkpoint is none") {
  const std::string bytes = checkpoint_bytes({7, job_id, "1.0", {3, 1.5, "the state of a bed"}});
  for (std::size_t kept = 0; kept < bytes.size(); ++kept) {
    CHECK_FALSE(checkpoint_from_bytes(bytes.substr(0, kept)));
  }
  for (std::size_t i = 0; i < 8 * bytes.size(); ++i) {
    std::string changed = bytes;
    changed[i / 8] = static_cast<char>(changed[i / 8] ^ (1 << (i % 8)));
    CHECK_FALSE(checkpoint_from_bytes(changed));
  }
  CHECK_FALSE(checkpoint_from_bytes(bytes + '\0'));
}

TEST_CASE("the newest checkpoint counts, in whatever file it is") {
  const TemporaryFolder folder;
  CHECK_FALSE(files_in_folder(folder).newest());
  CheckpointFiles files = files_in_folder(folder);
  for (int step = 1; step <= 5; ++step) {
    files.write({step, 0.5 * step, "state " + std::to_string(step)});
    const auto newest = files_in_folder(folder).newest().value();
    CHECK(newest.step == step);
    CHECK(newest.cpu_seconds == 0.5 * step);
    CHECK(newest.state == "state " + std::to_string(step));
  }
  CHECK(files_in(folder.path() + "/checkpoints", "", "").size() == 2);
}

TEST_CASE("where the newest is damaged the one before it is used, and replaced last") {
  const TemporaryFolder folder;
  CheckpointFiles files = files_in_folder(folder);
  files.write({1, 0, "first"});
  files.write({2, 0, "second"});
  damage(path_of(folder, 1));
  CheckpointFiles next = files_in_folder(folder);
  CHECK(next.newest().value().state == "first");
  next.write({3, 0, "third"});
  damage(path_of(folder, 1));
  CHECK(files_in_folder(folder).newest().value().state == "first");
  damage(path_of(folder, 0));
  CHECK_THROWS_WITH(files_in_folder(folder).newest(),
                    Catch::EndsWith("is damaged, or of another version"));
}

TEST_CASE("a checkpoint of another job or another build is not used") {
  const TemporaryFolder folder;
  files_in_folder(folder, "1.0").write({1, 0, "state"});
  CHECK_FALSE(files_in_folder(folder, "1.1").newest());
  replace_file(folder.path() + "/checkpoints/other.0", read_file(path_of(folder, 0)));
  CHECK_FALSE(CheckpointFiles(folder.path(), "other", "1.0").newest());
  CHECK(files_in_folder(folder, "1.0").newest());
}

TEST_CASE("checkpoints are removed by job, or all of them, and nothing else is") {
  const TemporaryFolder folder;
  for (const char* name : {"a", "b", "c"}) {
    CheckpointFiles files(folder.path(), name, "1.0");
    files.write({1, 0, "state"});
    files.write({2, 0, "state"});
  }
  replace_file(folder.path() + "/checkpoints/notes.txt", "mine");
  CheckpointFiles(folder.path(), "a", "1.0").remove();
  CheckpointFiles(folder.path(), "a", "1.0").remove();
  remove_checkpoints_of(folder.path(), {"b", "x"});
  CHECK(files_in(folder.path() + "/checkpoints", "", "") ==
        std::vector<std::string>{"c.0", "c.1", "notes.txt"});
  remove_all_checkpoints(folder.path());
  CHECK(files_in(folder.path() + "/checkpoints", "", "") == std::vector<std::string>{"notes.txt"});
  remove_all_checkpoints(folder.path() + "/none");
}

TEST_CASE("a checkpoint that cannot be removed is told, and the others are removed all the same") {
  const TemporaryFolder folder;
  const std::vector<std::string> told = {
      path_of(folder, 0) + ": cannot remove: Is a directory; it is not needed, remove it by hand"};
  for (const int how : {0, 1, 2}) {
    make_folder(path_of(folder, 0));
    replace_file(path_of(folder, 1), "state");
    CHECK((how == 0   ? files_in_folder(folder).remove()
           : how == 1 ? remove_checkpoints_of(folder.path(), {job_id})
                      : remove_all_checkpoints(folder.path())) == told);
    CHECK_FALSE(file_exists(path_of(folder, 1)));
  }
}

}  // namespace
}  // namespace grainsweep
