#include <catch2/catch.hpp>

#include "runner/commands/commands.hpp"
#include "runner/commands/results.hpp"
#include "runner/exit_codes.hpp"
#include "runner/store/files.hpp"
#include "tests/runner/commands/captured.hpp"
#include "tests/runner/sample_rows.hpp"
#include "tests/runner/temporary_folder.hpp"

namespace grainsweep {
namespace {

using Catch::Contains;

/// An output folder of one pending packing.
std::string folder_of_one(const TemporaryFolder& parent, const std::string& name) {
  std::string folder = parent.path() + "/" + name;
  make_folder(folder);
  Provenance provenance;
  provenance.sweep_name = "one";
  record_sweep(folder, provenance, {{sample_job("a1", 5), std::nullopt}});
  return folder;
}

TEST_CASE("a folder whose shards are submitted, but of which none has begun, says so") {
  const TemporaryFolder parent;
  const std::string folder = parent.path() + "/waits";
  make_folder(folder + "/slurm");
  StatusOptions options;
  options.folders = {folder};
  const Printed printed = printed_by([&] { CHECK(perform(options) == exit_done); });
  CHECK_THAT(printed.out, Contains(folder + ": submitted, nothing is made yet"));
  options.json = true;
  CHECK_THAT(printed_by([&] { perform(options); }).out, Contains("\"packings\": null"));
}

TEST_CASE("of several folders those that are there are told") {
  const TemporaryFolder parent;
  StatusOptions options;
  options.folders = {folder_of_one(parent, "a"), parent.path() + "/none",
                     folder_of_one(parent, "b")};
  options.json = true;
  const Printed printed = printed_by([&] { CHECK(perform(options) == exit_bad_input); });
  CHECK_THAT(printed.error, Contains("/none"));
  CHECK_THAT(printed.out, Contains(parent.path() + "/a") && Contains(parent.path() + "/b"));
  options.folders = {parent.path() + "/none"};
  CHECK_THROWS_AS(perform(options), BadInput);
}

}  // namespace
}  // namespace grainsweep
