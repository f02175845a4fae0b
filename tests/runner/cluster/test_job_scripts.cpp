#include <catch2/catch.hpp>

#include "runner/cluster/job_scripts.hpp"
#include "runner/exit_codes.hpp"

namespace grainsweep {
namespace {

using Catch::Contains;
using Catch::EndsWith;
using Catch::StartsWith;

ClusterRun small_run() {
  return {"/bin/grainsweep",
          "/a b/sweep.json",
          "/out/it's",
          "quick",
          "main",
          "0.01",
          {64, 16, 3e9, 1500.0, 1500.0, 3120.0, "it was asked for"}};
}

TEST_CASE("an array has an element for each shard, told before its time is up") {
  const std::string script = shards_script(small_run());
  for (const char* line :
       {"#!/bin/bash\n", "\n#SBATCH --array=1-64\n", "\n#SBATCH --partition=main\n",
        "\n#SBATCH --cpus-per-task=16\n", "\n#SBATCH --mem=2861M\n", "\n#SBATCH --time=0:52:00\n",
        "\n#SBATCH --requeue\n", "\n#SBATCH --open-mode=append\n", "\n#SBATCH --signal=B:TERM@90\n",
        "\n#SBATCH --output='/out/it'\\''s/slurm/%a.log'\n"}) {
    CHECK_THAT(script, Contains(line));
  }
  CHECK_THAT(script, Contains("\nexec /bin/grainsweep run '/a b/sweep.json' --out '/out/it'\\''s' "
                              "--threads 16 --quiet --shard \"$SLURM_ARRAY_TASK_ID/64\""));
}

TEST_CASE("the job behind the array tolerates what it is told to, and goes on when out of time") {
  const std::string script = rest_script(small_run());
  CHECK_THAT(script,
             Contains("--threads 16 --quiet --time-limit 0:52:00 --tolerate-unsettled=0.01\n"));
  CHECK_THAT(script, Contains("\n#SBATCH --time=0:52:00\n"));
  CHECK_THAT(script, Contains("if [ $code -eq 6 ]; then exec scontrol requeue"));
  CHECK_THAT(script, !Contains("--array") && !Contains("--shard"));
}

TEST_CASE("where no partition is known none is asked for") {
  ClusterRun run = small_run();
  run.partition = "";
  CHECK_THAT(shards_script(run), !Contains("partition") && Contains("--nodes=1"));
}

TEST_CASE("a folder may have a name that Slurm would take for a pattern") {
  ClusterRun run = small_run();
  run.folder = "/out/5%a";
  CHECK_THAT(shards_script(run), Contains("\n#SBATCH --output=/out/5%%a/slurm/%a.log\n"));
  CHECK_THAT(rest_script(run), Contains("\n#SBATCH --output=/out/5%%a/slurm/rest.log\n"));
}

TEST_CASE("a path that would end a line of a script is refused, with what names it") {
  CHECK_NOTHROW(refuse_controls(small_run().file, small_run().folder));
  ClusterRun run = small_run();
  run.folder = "/out/a\nrm -r b";
  CHECK_THROWS_WITH(refuse_controls(run.file, run.folder),
                    StartsWith("--out: \"/out/a?rm -r b\" holds a control"));
  run = small_run();
  run.file = "/a\x1B[31m.json";
  CHECK_THROWS_AS(refuse_controls(run.file, run.folder), BadInput);
  CHECK_THROWS_WITH(refuse_controls(run.file, run.folder),
                    StartsWith("FILE: ") && EndsWith("or its folder"));
}

TEST_CASE("nodes whose memory is not told are asked for none") {
  ClusterRun run = small_run();
  run.division.bytes = 0.0;
  CHECK_THAT(shards_script(run), !Contains("--mem"));
}

}  // namespace
}  // namespace grainsweep
