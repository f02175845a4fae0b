#include <map>

#include <catch2/catch.hpp>

#include "runner/commands/shard_option.hpp"
#include "runner/exit_codes.hpp"

namespace grainsweep {
namespace {

using Catch::Contains;
using Variables = std::map<std::string, std::string>;

Environment environment_of(const Variables& variables) {
  return [=](const char* name) {
    const auto found = variables.find(name);
    return found == variables.end() ? nullptr : found->second.c_str();
  };
}

Shard automatic(const Variables& variables, const std::string& option = "auto") {
  return shard_from_option(option, environment_of(variables));
}

TEST_CASE("a shard is given by number and count; without the option it is the whole sweep") {
  CHECK(shard_from_option("", environment_of({})) == Shard{1, 1});
  CHECK(shard_from_option("3/64", environment_of({})) == Shard{3, 64});
  for (const char* text : {"3", "0/4", "5/4", "3 / 64", "auto/", "auto/0", "auto/x", "automatic"}) {
    CHECK_THROWS_WITH(shard_from_option(text, environment_of({})),
                      Contains(std::string("--shard ") + text));
  }
}

TEST_CASE("a sweep has a million shards at most") {
  CHECK(shard_from_option("7/1000000", environment_of({})) == Shard{7, 1000000});
  for (const char* text : {"1/1000001", "auto/1000001"}) {
    CHECK_THROWS_WITH(shard_from_option(text, environment_of({})),
                      Contains(std::string("--shard ") + text));
  }
}

TEST_CASE("tasks of an engine are as few, however large the numbers in its variables") {
  const auto refused = [](const Variables& variables, const char* why) {
    CHECK_THROWS_WITH(automatic(variables), Contains(why));
  };
  const Variables array = {{"SLURM_ARRAY_TASK_ID", "1"},
                           {"SLURM_ARRAY_TASK_MIN", "1"},
                           {"SLURM_ARRAY_TASK_COUNT", "2000000000"}};
  refused(array, "2000000000 are too many: a sweep has 1000000 shards at most");
  Variables both = array;
  both["SLURM_ARRAY_TASK_COUNT"] = both["OMPI_COMM_WORLD_SIZE"] = "70000";
  both["OMPI_COMM_WORLD_RANK"] = "0";
  refused(both, "4900000000 are too many");
  refused({{"SGE_TASK_ID", "2147483647"},
           {"SGE_TASK_FIRST", "-2147483648"},
           {"SGE_TASK_LAST", "2147483647"}},
          "4294967296 are too many");
  refused({{"SLURM_PROCID", "7"}, {"SLURM_STEP_NUM_TASKS", "1000001"}}, "1000001 are too many");
}

TEST_CASE("every engine's tasks are shards from 1 on") {
  CHECK(automatic({{"SLURM_ARRAY_TASK_ID", "14"},
                   {"SLURM_ARRAY_TASK_MIN", "10"},
                   {"SLURM_ARRAY_TASK_STEP", "2"},
                   {"SLURM_ARRAY_TASK_COUNT", "5"}}) == Shard{3, 5});
  CHECK(automatic({{"SLURM_PROCID", "0"}, {"SLURM_STEP_NUM_TASKS", "64"}}) == Shard{1, 64});
  CHECK(automatic({{"OMPI_COMM_WORLD_RANK", "3"}, {"OMPI_COMM_WORLD_SIZE", "4"}}) == Shard{4, 4});
  CHECK(automatic({{"PMI_RANK", "1"}, {"PMI_SIZE", "2"}}) == Shard{2, 2});
  CHECK(automatic({{"FLUX_TASK_RANK", "5"}, {"FLUX_JOB_SIZE", "8"}}) == Shard{6, 8});
  CHECK(automatic({{"SGE_TASK_ID", "9"},
                   {"SGE_TASK_FIRST", "1"},
                   {"SGE_TASK_LAST", "15"},
                   {"SGE_TASK_STEPSIZE", "4"}}) == Shard{3, 4});
}

TEST_CASE("steps and counts that no engine gives do no harm") {
  CHECK(automatic({{"SLURM_ARRAY_TASK_ID", "2"},
                   {"SLURM_ARRAY_TASK_MIN", "1"},
                   {"SLURM_ARRAY_TASK_STEP", "0"},
                   {"SLURM_ARRAY_TASK_COUNT", "5"}}) == Shard{2, 5});
  CHECK(
      automatic(
          {{"PBS_ARRAY_INDEX", "2"}, {"OMPI_COMM_WORLD_RANK", "0"}, {"OMPI_COMM_WORLD_SIZE", "0"}},
          "auto/4") == Shard{2, 4});
}

TEST_CASE("where an engine tells no count it is given, and agrees where it is told") {
  for (const char* name : {"PBS_ARRAY_INDEX", "PBS_ARRAYID", "HQ_TASK_ID"}) {
    CHECK(automatic({{name, "7"}}, "auto/12") == Shard{7, 12});
    CHECK_THROWS_WITH(automatic({{name, "7"}}), Contains("--shard auto/64"));
    CHECK_THROWS_WITH(automatic({{name, "13"}}, "auto/12"), Contains("task 13 of 12"));
    CHECK_THROWS_AS(automatic({{name, "0"}}, "auto/12"), BadInput);
  }
  CHECK(automatic({{"PMI_RANK", "1"}, {"PMI_SIZE", "2"}}, "auto/2") == Shard{2, 2});
  CHECK_THROWS_WITH(automatic({{"PMI_RANK", "1"}, {"PMI_SIZE", "2"}}, "auto/3"),
                    Contains("task 2 of 2, not one of 3"));
}

TEST_CASE("tasks within the elements of an array are shards of both") {
  const Variables both = {{"SLURM_ARRAY_TASK_ID", "2"},
                          {"SLURM_ARRAY_TASK_MIN", "1"},
                          {"SLURM_ARRAY_TASK_COUNT", "3"},
                          {"SLURM_PROCID", "1"},
                          {"SLURM_STEP_NUM_TASKS", "4"}};
  CHECK(automatic(both) == Shard{6, 12});
  CHECK(automatic({{"PBS_ARRAY_INDEX", "2"}, {"PMI_RANK", "1"}, {"PMI_SIZE", "4"}}, "auto/12") ==
        Shard{6, 12});
}

TEST_CASE("mpirun counts, not the allocation it runs in; a script of a batch job is one task") {
  CHECK(automatic({{"OMPI_COMM_WORLD_RANK", "7"},
                   {"OMPI_COMM_WORLD_SIZE", "8"},
                   {"SLURM_PROCID", "0"},
                   {"SLURM_STEP_NUM_TASKS", "2"}}) == Shard{8, 8});
  CHECK_THROWS_AS(automatic({{"SLURM_PROCID", "0"}, {"SLURM_NTASKS", "8"}}), BadInput);
}

TEST_CASE("without any such variable the error lists what was looked for") {
  CHECK_THROWS_WITH(
      automatic({{"SGE_TASK_ID", "undefined"}, {"SGE_TASK_FIRST", "undefined"}}),
      Contains("SLURM_ARRAY_TASK_ID, SLURM_ARRAY_TASK_MIN and SLURM_ARRAY_TASK_COUNT") &&
          Contains("SGE_TASK_ID") && Contains("PBS_ARRAY_INDEX") && Contains("HQ_TASK_ID") &&
          Contains("OMPI_COMM_WORLD_RANK") && Contains("PMI_RANK") && Contains("FLUX_TASK_RANK") &&
          Contains("--shard 3/64"));
}

TEST_CASE("an array with gaps is refused") {
  CHECK_THROWS_WITH(automatic({{"SLURM_ARRAY_TASK_ID", "9"},
                               {"SLURM_ARRAY_TASK_MIN", "1"},
                               {"SLURM_ARRAY_TASK_COUNT", "3"}}),
                    Contains("task 9 of 3") && Contains("without gaps"));
}

}  // namespace
}  // namespace grainsweep
