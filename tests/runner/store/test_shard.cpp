#include <catch2/catch.hpp>

#include "runner/store/files.hpp"
#include "runner/store/shard.hpp"
#include "tests/runner/temporary_folder.hpp"

namespace grainsweep {
namespace {

TEST_CASE("a shard has the name that it is known by") {
  CHECK(name_of({3, 64}) == "3-of-64");
  CHECK(shard_from_name("3-of-64") == Shard{3, 64});
  CHECK(shard_from_name("3-of-64-node.7-4711") == Shard{3, 64});
  CHECK(shard_from_text("64/64") == Shard{64, 64});
}

TEST_CASE("what is no shard is none") {
  for (const char* text :
       {"", "3", "3/", "/3", "0/3", "4/3", "-1/3", "1/3x", "1/99999999999", "a/b"}) {
    CHECK_FALSE(shard_from_text(text));
  }
  CHECK_FALSE(shard_from_name("4-of-3"));
  CHECK_FALSE(shard_from_name("notes"));
}

TEST_CASE("the shards of a folder are those with a journal") {
  const TemporaryFolder folder;
  CHECK(shards_in(folder.path()).empty());
  make_folder(shards_folder(folder.path()));
  for (const char* name :
       {"2-of-2.jsonl", "1-of-2.jsonl", "1-of-2.beds", "3-of-4.beds", "x.jsonl", "y.beds"}) {
    replace_file(shards_folder(folder.path()) + "/" + name, "");
  }
  CHECK(shards_in(folder.path()) == std::vector<std::string>{"1-of-2", "2-of-2"});
  CHECK(beds_without_journal(folder.path()) ==
        std::vector<std::string>{beds_path(folder.path(), "3-of-4")});
}

}  // namespace
}  // namespace grainsweep
