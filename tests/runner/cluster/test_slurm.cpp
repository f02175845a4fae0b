#include <cmath>

#include <catch2/catch.hpp>

#include "runner/cluster/slurm.hpp"
#include "runner/exit_codes.hpp"

namespace grainsweep {
namespace {

using Catch::Contains;

const std::vector<Partition> two_partitions = partitions_in(
    "sinfo: warning: something\n"
    "long|infinite|128+|1|3\n"
    "main*|1-12:00:00|64|256000|20\n"
    "main*|1-12:00:00|32|512000|2\n"
    "debug|30:00|16|64000|0");

TEST_CASE("what sinfo says of partitions is read, of different nodes the least") {
  REQUIRE(two_partitions.size() == 3);
  const ClusterLimits& long_limits = two_partitions[0].limits;
  CHECK(long_limits.seconds == 0.0);
  CHECK(long_limits.cores == 128);
  CHECK(std::isinf(long_limits.memory));  // 1 MB: not configured
  const Partition& main = chosen(two_partitions, "");
  CHECK(main.name == "main");
  CHECK(main.limits.nodes == 22);
  CHECK(main.limits.cores == 32);
  CHECK(main.limits.memory == 256000.0 * 1048576.0);
  CHECK(main.limits.seconds == 36 * 3600.0);
  CHECK(two_partitions[2].limits.seconds == 1800.0);
  const auto mixed = partitions_in("mixed|infinite|8|64000|4\nmixed|infinite|16|1|2\n");
  CHECK(chosen(mixed, "mixed").limits.cores == 8);
  CHECK(partitions_in("odd|infinite|?|1|1").at(0).limits.cores == 1);
  CHECK(chosen(mixed, "mixed").limits.memory ==
        64000.0 * 1048576.0);  // that of those which tell it
}

TEST_CASE("a partition that is not there or has no nodes is refused with those there are") {
  CHECK(chosen(two_partitions, "long").limits.nodes == 3);
  CHECK_THROWS_WITH(chosen(two_partitions, "short"),
                    Contains("--partition short") && Contains("it has: long, main, debug"));
  CHECK_THROWS_WITH(chosen(two_partitions, "debug"), Contains("debug has no nodes"));
  CHECK_THROWS_WITH(chosen(partitions_in("only|infinite|1|1|1"), ""),
                    Contains("no default partition"));
  CHECK_THROWS_AS(chosen({}, ""), BadInput);
}

TEST_CASE("an array has one element less than its greatest index, from 1 on") {
  CHECK(array_limit_in("LaunchType = x\nMaxArraySize            = 1001\nMaxDBDMsgs = 5") == 1000);
  CHECK(array_limit_in("MaxArraySize = 2") == 1);
  CHECK(array_limit_in("nothing of it") == 0);
  for (const char* none : {"MaxArraySize = 0", "MaxArraySize = 1"}) {
    CHECK_THROWS_WITH(array_limit_in(none), Catch::Contains("takes no arrays of jobs"));
  }
}

TEST_CASE("of the queue those jobs count whose scripts lie in the folder") {
  const Queue queue = queue_in(
      "RUNNING|None|/out/slurm/shards.sh\nCOMPLETING|None|/out/slurm/shards.sh\n"
      "PENDING|Resources|/out/slurm/shards.sh\nPREEMPTED|None|/out/slurm/shards.sh\n"
      "PENDING|JobHeldUser|/out/slurm/shards.sh\nPENDING|Dependency|/out/slurm/rest.sh\n"
      "PENDING|QOSMaxJobsPerUserLimit|/out/slurm/shards.sh\n"
      "RUNNING|None|/out/slurm2/shards.sh\nRUNNING|None|/other.sh",
      "/out/slurm");
  CHECK(queue.running == 2);
  CHECK(queue.pending == 5);
  CHECK(queue.blocking == "JobHeldUser");
  CHECK(queue_in("", "/out/slurm").pending == 0);
}

}  // namespace
}  // namespace grainsweep
