#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "runner/commands/command_line.hpp"
#include "runner/exit_codes.hpp"
#include "tests/runner/commands/captured.hpp"

namespace grainsweep {
namespace {

/// What was read, and what was printed.
struct Reading : Printed {
  CommandLine line;
};

Reading read(std::vector<const char*> words) {
  words.insert(words.begin(), "grainsweep");
  CommandLine line;
  const Printed printed =
      printed_by([&] { line = read_command_line(static_cast<int>(words.size()), words.data()); });
  return {printed, line};
}

template <class Options>
Options options_of(const Reading& reading) {
  REQUIRE(reading.line.command);
  return std::get<Options>(*reading.line.command);
}

TEST_CASE("run takes its options in any order") {
  const auto options = options_of<RunOptions>(
      read({"run", "--threads", "8", "a.json", "--out", "o", "--isa", "sse2", "--fresh", "--yes",
            "--quiet", "--retry-failed", "--fail-fast", "--checkpoint-seconds", "2.5"}));
  CHECK(options.file == "a.json");
  CHECK(options.out == "o");
  CHECK(options.threads == 8);
  CHECK(options.isa == "sse2");
  CHECK(options.fresh);
  CHECK(options.yes);
  CHECK(options.quiet);
  CHECK(options.retry_failed);
  CHECK(options.fail_fast);
  CHECK(options.checkpoint_seconds == 2.5);
}

TEST_CASE("a stopped run goes on with its options, but for those that count once") {
  const auto repeated = [](std::vector<const char*> words) {
    return options_of<RunOptions>(read(std::move(words))).repeated;
  };
  CHECK(repeated({"run", "--out=o", "a.json", "--fresh", "--yes", "--retry-failed"}) == "");
  CHECK(repeated({"run", "--time-limit=1:30:00", "--threads=2", "a.json", "--quiet", "--shard",
                  "1/2", "--alone", "--tolerate-unsettled=0.25"}) ==
        " --threads 2 --quiet --shard 1/2 --alone --time-limit 1:30:00 --tolerate-unsettled=0.25");
  CHECK(repeated({"run", "a.json", "--tolerate-unsettled", "--time-limit", "an hour"}) ==
        " --time-limit 'an hour' --tolerate-unsettled=1");
}

TEST_CASE("options not given have their defaults") {
  const auto options = options_of<RunOptions>(read({"run", "a.json"}));
  CHECK(options.out.empty());
  CHECK(options.threads == 0);
  CHECK_FALSE(options.fresh);
  CHECK_FALSE(options.retry_failed);
  CHECK_FALSE(options.fail_fast);
  CHECK(options.checkpoint_seconds == 60.0);
  CHECK(options_of<ExportOptions>(read({"export", "o"})).format == "csv");
  CHECK(options_of<ExportOptions>(read({"export", "o", "--format", "STL"})).format == "stl");
}

TEST_CASE("a share of unsettled packings is tolerated as given, and without a number any share") {
  const auto share = [](const char* option) {
    return options_of<RunOptions>(read({"run", "a.json", option})).tolerate_unsettled;
  };
  CHECK(share("--quiet") == 0.0);
  CHECK(share("--tolerate-unsettled") == 1.0);
  CHECK(share("--tolerate-unsettled=0.25") == 0.25);
  CHECK(share("--tolerate-unsettled=1e-400") == 0.0);
  CHECK(options_of<SlurmOptions>(read({"slurm", "a.json", "--tolerate-unsettled=1e-3"}))
            .tolerate_unsettled == 1e-3);
}

TEST_CASE("every command is understood") {
  CHECK(options_of<ValidateOptions>(read({"validate", "a.json"})).file == "a.json");
  CHECK(options_of<PlanOptions>(read({"plan", "a.json", "--json"})).json);
  CHECK(options_of<ReportOptions>(read({"report", "o"})).folder == "o");
  CHECK(options_of<StatusOptions>(read({"status", "o"})).folders.front() == "o");
  CHECK_FALSE(options_of<StatusOptions>(read({"status", "o"})).json);
  CHECK(options_of<StatusOptions>(read({"status", "o", "--json"})).json);
  options_of<DoctorOptions>(read({"doctor"}));
  CHECK_FALSE(options_of<ColumnsOptions>(read({"columns"})).markdown);
  CHECK(options_of<ColumnsOptions>(read({"columns", "--markdown"})).markdown);
  options_of<SchemaOptions>(read({"schema"}));
  CHECK(options_of<InitOptions>(read({"init"})).name == "my-sweep");
  CHECK(options_of<InitOptions>(read({"init", "walls"})).name == "walls");
  const auto collect = options_of<CollectOptions>(read({"collect", "a", "b", "--out", "c"}));
  CHECK(collect.folders == std::vector<std::string>{"a", "b"});
  CHECK(collect.out == "c");
  const auto grains = options_of<ExportOptions>(
      read({"export", "--job", "a", "--job", "b", "o", "--format", "vtp", "--to", "t"}));
  CHECK(grains.folder == "o");
  CHECK(grains.jobs == std::vector<std::string>{"a", "b"});
  CHECK(options_of<RunOptions>(read({"run", "--job", "a,b", "s.json", "--job", "c"})).jobs ==
        std::vector<std::string>{"a", "b", "c"});
  CHECK(grains.format == "vtp");
  CHECK(grains.to == "t");
}

TEST_CASE("mistakes are refused with exit code 2 and a message") {
  const std::vector<std::vector<const char*>> mistakes = {
      {},
      {"walk"},
      {"run"},
      {"run", "a.json", "--thread", "2"},
      {"run", "a.json", "b.json"},
      {"run", "a.json", "--threads", "0"},
      {"run", "a.json", "--threads", "many"},
      {"run", "a.json", "--threads", "-1"},
      {"export", "o", "--format", "ply"},
      {"report"},
      {"run", "a.json", "--checkpoint-seconds", "-1"},
      {"run", "a.json", "--checkpoint-seconds", "nan"},
      {"run", "a.json", "--checkpoint-seconds", ""},
      {"run", "a.json", "--tolerate-unsettled=nan"},
      {"run", "a.json", "--tolerate-unsettled=inf"},
      {"run", "a.json", "--tolerate-unsettled=half"},
      {"slurm", "a.json", "--tolerate-unsettled=nan"},
      {"export", "o", "--format", "voxels", "--voxels", "nan"},
      {"export", "o", "--format", "voxels", "--voxels", "20d"},
      {"collect", "a"},
      {"collect", "--out", "b"},
      {"run", "a.json", "--out", ""},
      {"export", "a", "--to", ""},
      {"completion", "bash"},
      {"doctor", "--quiet"}};
  for (const auto& words : mistakes) {
    const Reading reading = read(words);
    CHECK_FALSE(reading.line.command);
    CHECK(reading.line.exit_code == exit_bad_input);
    CHECK_FALSE(reading.error.empty());
    CHECK(reading.out.empty());
  }
}

TEST_CASE("a misspelt command or option is named with the likely one") {
  const auto first_line = [](const std::vector<const char*>& words) {
    const std::string error = read(words).error;
    return error.substr(0, error.find('\n'));
  };
  CHECK(first_line({"rnu", "x.json"}) == "grainsweep: unknown command rnu; did you mean run?");
  CHECK(first_line({"pack"}) ==
        "grainsweep: unknown command pack; known: help, version, run, init, validate, plan, slurm, "
        "report, "
        "compare, export, status, collect, schema, columns, manual, doctor");
  CHECK(first_line({"help", "plna"}) == "grainsweep: unknown command plna; did you mean plan?");
  CHECK(first_line({"run", "x.json", "--treads", "2"}) ==
        "grainsweep: unknown option --treads; did you mean --threads?");
  CHECK(first_line({"run", "x.json", "--treads=2"}) ==
        "grainsweep: unknown option --treads; did you mean --threads?");
  CHECK(first_line({"run", "x.json", "--threads", "0"}).starts_with("grainsweep: --threads: "));
  CHECK(first_line({"run", "x.json", "--checkpoint-seconds", "nan"}) ==
        "grainsweep: --checkpoint-seconds: must be a number in [0, 86400], is nan");
}

TEST_CASE("mistakes are told without what a terminal would obey") {
  CHECK(read({"run", "--\x1B[31m"}).error.find('\x1B') == std::string::npos);
  CHECK(read({"\x1B[31m"}).error.find("unknown command ?[31m") != std::string::npos);
}

TEST_CASE("help has the commands, an example and the exit codes, and ends with code 0") {
  const Reading reading = read({"--help"});
  CHECK(reading.line.exit_code == 0);
  CHECK_FALSE(reading.line.command);
  for (const char* word : {"run", "validate", "plan", "report", "export", "status", "doctor",
                           "collect", "schema", "Example:", "Exit codes:"}) {
    CHECK_THAT(reading.out, Catch::Contains(word));
  }
}

TEST_CASE("help and version are commands, too") {
  for (const auto& [words, same] :
       std::vector<std::pair<std::vector<const char*>, std::vector<const char*>>>{
           {{"help"}, {"--help"}},
           {{"help", "run"}, {"run", "--help"}},
           {{"version"}, {"--version"}}}) {
    const Reading reading = read(words);
    CHECK(reading.line.exit_code == 0);
    CHECK_FALSE(reading.line.command);
    CHECK(reading.out == read(same).out);
  }
}

TEST_CASE("help of every command fits 100 columns and has an example as the program was called") {
  setenv("GRAINSWEEP_COMMAND", "./run.sh", 1);
  for (const char* command : {"run", "validate", "plan", "report", "export", "status", "collect"}) {
    const Reading reading = read({command, "--help"});
    CHECK(reading.line.exit_code == 0);
    CHECK_THAT(reading.out, Catch::Contains("Example: ./run.sh " + std::string(command)));
    std::istringstream lines(reading.out);
    for (std::string line; std::getline(lines, line);) CHECK(line.size() <= 100);
  }
}

TEST_CASE("an option whose value may be left out is so written in the help") {
  for (const char* command : {"run", "slurm"}) {
    CHECK_THAT(read({command, "--help"}).out, Catch::Contains("  --tolerate-unsettled[=SHARE]\n"));
  }
}

TEST_CASE("whoever compares two runs is told what compare does, and how they are compared") {
  CHECK_THAT(read({"compare", "a", "b"}).error,
             Catch::Contains("published values") && Catch::Contains("groups.csv"));
  CHECK_THAT(read({"report", "a", "b"}).error, !Catch::Contains("groups.csv"));
}

TEST_CASE("the version is printed") {
  const Reading reading = read({"--version"});
  CHECK(reading.line.exit_code == 0);
  CHECK_THAT(reading.out, Catch::Matches("grainsweep [0-9]+\\.[0-9]+\\.[0-9]+ \\(.+\\)\n"));
}

}  // namespace
}  // namespace grainsweep
