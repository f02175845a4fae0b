#include <fstream>

#include <catch2/catch.hpp>

#include "runner/store/claims.hpp"
#include "runner/store/files.hpp"
#include "runner/store/shard.hpp"
#include "tests/runner/temporary_folder.hpp"

namespace grainsweep {
namespace {

using Jobs = std::vector<std::string>;

class SharedFolder {
 public:
  SharedFolder() { make_folder(shards_folder(folder_.path())); }
  Claims claims_of(const std::string& runner, const std::set<std::string>& at_work) const {
    return {folder_.path(), runner, at_work};
  }
  const std::string& path() const { return folder_.path(); }
  std::string claims_path() const { return shards_folder(path()) + "/claims"; }
  void append(const std::string& bytes) const {
    std::ofstream(claims_path(), std::ios::app) << bytes;
  }

 private:
  TemporaryFolder folder_;
};

TEST_CASE("before a runner helps, all may begin what they like and leave no file") {
  const SharedFolder folder;
  Claims claims = folder.claims_of("a-1", {});
  CHECK(claims.may_begin("one"));
  CHECK(claims.owner_of("one").empty());
  CHECK_FALSE(file_exists(folder.claims_path()));
}

TEST_CASE("the first claim of a job counts") {
  const SharedFolder folder;
  Claims one = folder.claims_of("a-1", {"a-1", "b-2"}), other = folder.claims_of("b-2", {"a-1"});
  open_claims(folder.path());
  CHECK(one.take({"p", "q"}) == Jobs{"p", "q"});
  CHECK(other.take({"q", "r"}) == Jobs{"r"});
  CHECK_FALSE(other.may_begin("p"));
  CHECK(one.may_begin("q"));
  CHECK_FALSE(one.may_begin("r"));
  CHECK(one.owner_of("r") == "b-2");
  CHECK(other.take({}).empty());
}

TEST_CASE("of two claims that were written at the same time the earlier line counts for both") {
  const SharedFolder folder;
  Claims one = folder.claims_of("a-1", {}), other = folder.claims_of("b-2", {});
  folder.append("\np b-2\n\np a-1\n");
  CHECK(one.take({"p"}).empty());
  CHECK(other.take({"p"}) == Jobs{"p"});
}

TEST_CASE("claims of runners that are gone are void, those of later ones are not") {
  const SharedFolder folder;
  folder.append("\np dead-7\nq dead-7\nr b-2\nq b-2\n");
  Claims claims = folder.claims_of("a-1", {"b-2"});
  CHECK(claims.abandoned() == std::set<std::string>{"p"});
  CHECK(claims.owner_of("q") == "b-2");
  folder.append("\np late-9\n");
  CHECK_FALSE(claims.may_begin("p"));
  CHECK(claims.abandoned().empty());
}

TEST_CASE("a runner's own claims of before are not void, whoever it is told to be at work") {
  const SharedFolder folder;
  folder.append("\np a-1\n");
  Claims claims = folder.claims_of("a-1", {"b-2"});
  CHECK(claims.owner_of("p") == "a-1");
  CHECK(claims.abandoned().empty());
}

TEST_CASE("a claim that is being written counts once it is whole") {
  const SharedFolder folder;
  folder.append("\np b-");
  Claims claims = folder.claims_of("a-1", {"b-2"});
  CHECK(claims.owner_of("p").empty());
  folder.append("2\n");
  CHECK_FALSE(claims.may_begin("p"));
  CHECK(claims.owner_of("p") == "b-2");
}

TEST_CASE("a torn claim is none, and does not spoil the next one") {
  const SharedFolder folder;
  folder.append("\np b-");
  Claims claims = folder.claims_of("a-1", {"b-2"});
  CHECK(claims.owner_of("p").empty());
  CHECK(claims.take({"q"}) == Jobs{"q"});
  CHECK(folder.claims_of("b-2", {"a-1"}).owner_of("q") == "a-1");
}

TEST_CASE("when the sweep is made claims are forgotten, and runners that still look find none") {
  const SharedFolder folder;
  Claims claims = folder.claims_of("a-1", {});
  CHECK(claims.take({"p"}) == Jobs{"p"});
  forget_claims(folder.path());
  CHECK_FALSE(file_exists(folder.claims_path()));
  CHECK(claims.may_begin("q"));
  CHECK(folder.claims_of("b-2", {"a-1"}).owner_of("p").empty());
}

}  // namespace
}  // namespace grainsweep
