#include <fstream>

#include <catch2/catch.hpp>

#include "runner/export/file_names.hpp"
#include "runner/store/files.hpp"
#include "tests/runner/temporary_folder.hpp"

namespace grainsweep {
namespace {

Row row_of(const std::string& job, const std::string& label, const std::string& parameters,
           int replicate) {
  Row row;
  row.job.id = job;
  row.job.label = label;
  row.job.parameters = parameters;
  row.job.replicate = replicate;
  return row;
}

std::vector<Row> four_rows() {
  return {row_of("a", "x/y, z", "{1}", 1), row_of("b", "x/y, z", "{1}", 2),
          row_of("c", "x_y_ z", "{1}", 1), row_of("d", "x/y, z", "{2}", 1)};
}

TEST_CASE("files are called by label, group and replicate, and no two alike") {
  CHECK(file_stems(four_rows()) ==
        std::vector<std::string>{"x_y__z-1-1", "x_y__z-1-2", "x_y__z-2-1", "x_y__z-3-1"});
}

TEST_CASE("files of groups of several seeds have the seed in their names") {
  std::vector<Row> rows = four_rows();
  rows.push_back(rows[0]);
  rows.back().job.id = "e";
  rows.back().job.seed = 5;
  CHECK(file_stems(rows) == std::vector<std::string>{"x_y__z-1-1-seed0", "x_y__z-1-2-seed0",
                                                     "x_y__z-2-1", "x_y__z-3-1",
                                                     "x_y__z-1-1-seed5"});
}

TEST_CASE("a character of any script is one in the name of a file") {
  CHECK(file_stems({row_of("a", "20 \u00b5m", "{}", 1)}) == std::vector<std::string>{"20__m-1-1"});
}

TEST_CASE("no file is hidden, and none is put into another folder") {
  CHECK(file_stems({row_of("a", "../b", "{}", 1)}) == std::vector<std::string>{"_._b-1-1"});
}

const std::string index_head = "file,job,label,group,replicate,seed,status,unit\n";

TEST_CASE("the index lists the files that are written, and those there that it has listed") {
  const TemporaryFolder folder;
  const std::string written = "x_y__z-1-2.xyz,b,\"x/y, z\",1,2,0,pending,mm\n",
                    listed = "x_y__z-3-1.csv,d,\"x/y, z\",3,1,0,pending,d\n";
  for (const char* file : {"x_y__z-1-2.xyz", "x_y__z-3-1.csv", "x_y__z-1-1.csv"}) {
    std::ofstream(folder.path() + "/" + file) << "0";
  }
  const auto index = [&] {
    return index_csv(folder.path(), four_rows(), {".csv", ".xyz"}, {{"x_y__z-1-2.xyz", ""}}, "mm");
  };
  CHECK(index() == index_head + written);
  std::ofstream(folder.path() + "/index.csv") << index_head + listed;
  CHECK(index() == index_head + written + listed);
}

TEST_CASE("a file that another packing would be called now stays that of its own in the index") {
  const TemporaryFolder folder;
  const std::string before = "x_y__z-3-1.csv,other,\"x/y, z\",3,1,0,settled,d\n",
                    gone = "x_y__z-1-1.csv,gone,\"x/y, z\",1,1,0,settled,d\n";
  std::ofstream(folder.path() + "/x_y__z-3-1.csv") << "0";
  std::ofstream(folder.path() + "/index.csv") << index_head + gone + before;
  CHECK(index_csv(folder.path(), four_rows(), {".csv"}, {}, "d") == index_head + before);
  CHECK(index_csv(folder.path(), four_rows(), {".csv"}, {{"x_y__z-3-1.csv", ""}}, "d") ==
        index_head + "x_y__z-3-1.csv,d,\"x/y, z\",3,1,0,pending,d\n");
}

TEST_CASE("before files are replaced the index forgets those that were another packing's") {
  const TemporaryFolder folder;
  const std::string same = "a-1-1.csv,a,a,1,1,0,settled,d\n",
                    other = "a-2-1.csv,b,a,2,1,0,settled,d\n";
  CHECK_FALSE(index_without(folder.path(), {{"a-1-1.csv", "a"}}));
  std::ofstream(folder.path() + "/index.csv") << index_head + same + other;
  CHECK_FALSE(index_without(folder.path(), {{"a-1-1.csv", "a"}}));
  CHECK(index_without(folder.path(), {{"a-1-1.csv", "a"}, {"a-2-1.csv", "c"}}) ==
        index_head + same);
}

TEST_CASE("files of an index without units keep their lines, with the unit left empty") {
  const TemporaryFolder folder;
  const std::string old_head = "file,job,label,group,replicate,seed,status\n",
                    other = "a-2-1.csv,b,a,2,1,0,settled", known = "x_y__z-3-1.csv,d,";
  for (const char* file : {"a-2-1.csv", "x_y__z-3-1.csv"}) {
    std::ofstream(folder.path() + "/" + file) << "0";
  }
  std::ofstream(folder.path() + "/index.csv")
      << old_head + other + "\n" + known + "\"x/y, z\",3,1,0,settled\n";
  CHECK(index_csv(folder.path(), four_rows(), {".csv"}, {}, "mm") ==
        index_head + known + "\"x/y, z\",3,1,0,pending,\n" + other + ",\n");
  CHECK(index_without(folder.path(), {{"x_y__z-3-1.csv", "c"}}) == index_head + other + ",\n");
}

TEST_CASE("a packing whose group has another number is listed once for an ending") {
  const TemporaryFolder folder;
  const std::string as_table = "x.y-7-1.csv,d,x.y,7,1,0,settled,d\n",
                    as_contacts = "x.y-7-1.contacts.csv,d,x.y,7,1,0,settled,d\n",
                    other = "x.y-8-1.csv,other,x.y,8,1,0,settled,d\n",
                    now = "x_y__z-3-1.csv,d,\"x/y, z\",3,1,0,pending,d\n";
  for (const char* file :
       {"x_y__z-3-1.csv", "x.y-7-1.csv", "x.y-7-1.contacts.csv", "x.y-8-1.csv"}) {
    std::ofstream(folder.path() + "/" + file) << "0";
  }
  std::ofstream(folder.path() + "/index.csv") << index_head + as_table + as_contacts + other;
  CHECK(index_csv(folder.path(), four_rows(), {".csv"}, {{"x_y__z-3-1.csv", "d"}}, "d") ==
        index_head + now + as_contacts + other);
  CHECK(index_csv(folder.path(), four_rows(), {".csv"}, {}, "d") ==
        index_head + as_contacts + as_table + other);
  CHECK(superseded(folder.path(), {{"x_y__z-3-1.csv", "d"}}) ==
        std::vector<std::string>{"x.y-7-1.csv"});
  CHECK(superseded(folder.path(), {{"x.y-7-1.csv", "d"}}).empty());
  CHECK(superseded(folder.path(), {}).empty());
  remove_file(folder.path() + "/x.y-7-1.csv");
  CHECK(superseded(folder.path(), {{"x_y__z-3-1.csv", "d"}}).empty());
}

}  // namespace
}  // namespace grainsweep
