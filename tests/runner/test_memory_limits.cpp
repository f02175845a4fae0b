#include <cmath>
#include <filesystem>
#include <fstream>

#include <catch2/catch.hpp>
#include <sys/resource.h>

#include "runner/memory_limits.hpp"
#include "tests/runner/temporary_folder.hpp"

namespace grainsweep {
namespace {

/// A file system of control groups.
class Groups {
 public:
  void add(const std::string& path, const std::string& text) const {
    const std::filesystem::path file = folder_.path() + path;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file) << text << "\n";
  }
  double left(const std::string& groups) const {
    return memory_left_in_groups(groups, folder_.path());
  }

 private:
  TemporaryFolder folder_;
};

TEST_CASE("of nested groups of version 2 the one with least left counts") {
  const Groups groups;
  groups.add("/memory.max", "max");
  groups.add("/job/memory.max", "1000");
  groups.add("/job/memory.current", "700");
  groups.add("/job/step/memory.max", "max");
  groups.add("/job/step/task/memory.max", "800");
  groups.add("/job/step/task/memory.current", "100");
  CHECK(groups.left("0::/job/step/task\n") == 300);
  CHECK(groups.left("0::/job/step\n") == 300);
  groups.add("/job/memory.stat", "anon 100\ninactive_file 600\nactive_file 0");
  CHECK(groups.left("0::/job/step/task\n") == 700);
}

TEST_CASE("the memory group of version 1 counts, among others and below others") {
  const Groups groups;
  groups.add("/memory/slurm/job/memory.limit_in_bytes", "5000");
  groups.add("/memory/slurm/job/memory.usage_in_bytes", "4000");
  groups.add("/memory/slurm/job/memory.stat", "inactive_file 1\ntotal_inactive_file 500");
  groups.add("/memory/slurm/job/step/memory.limit_in_bytes", "9223372036854771712");
  CHECK(groups.left("5:cpu,cpuacct:/x\n4:memory:/slurm/job/step\n0::/\n") == 1500);
  CHECK(groups.left("4:hugetlb,memory:/slurm/job\n") == 1500);
  CHECK(std::isinf(groups.left("4:pids:/slurm/job\n")));
}

// As in a container whose own group is mounted at the root.
TEST_CASE("a group that is not to be seen leaves the limit of the root") {
  const Groups groups;
  groups.add("/memory.max", "2000");
  groups.add("/memory.current", "2500");
  CHECK(groups.left("0::/docker/4711\n") == 0);
  groups.add("/memory.current", "500");
  CHECK(groups.left("0::/docker/4711\n") == 1500);
  CHECK(groups.left("0::/\n") == 1500);
  CHECK(std::isinf(groups.left("")));
}

TEST_CASE("a limit on addresses counts, less those in use") {
  rlimit before{};
  REQUIRE(getrlimit(RLIMIT_AS, &before) == 0);
  rlimit less = before;
  less.rlim_cur = rlim_t{1} << 50;
  if (setrlimit(RLIMIT_AS, &less) != 0) return;  // a lower one holds: it is no longer ours to set
  CHECK(addresses_left() < std::ldexp(1.0, 50));
  CHECK(addresses_left() > 0.0);
  setrlimit(RLIMIT_AS, &before);
  if (before.rlim_cur == RLIM_INFINITY) CHECK(std::isinf(addresses_left()));
}

}  // namespace
}  // namespace grainsweep
