#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "runner/tables/outline.hpp"
#include "runner/tables/provenance.hpp"
#include "tests/runner/sample_rows.hpp"

namespace grainsweep {
namespace {

TEST_CASE("the outline of a provenance names the sweep, its file and its jobs in order") {
  Provenance provenance;
  provenance.sweep_file = "my \"odd\" file.json";
  provenance.sweep = {"a", {sample_job("z", 5), sample_job("b", 6), sample_job("c", 5)}};
  provenance.sweep.jobs.front().label = "id";
  provenance.runs.emplace_back();
  const Outline outline = outline_from_text(provenance_text(provenance, {}));
  CHECK(outline.name == "a");
  CHECK(outline.sweep_file == provenance.sweep_file);
  CHECK(outline.jobs == std::vector<std::string>{"z", "b", "c"});
}

TEST_CASE("what is no provenance has no outline") {
  for (const char* text : {"", "{", "[]", "{}", R"({"sweep_file": "a"})", R"({"sweep_file": 1})",
                           R"({"sweep": {"name": "a", "jobs": []}})", "{} {}"}) {
    CHECK_THROWS_AS(outline_from_text(text), nlohmann::json::exception);
  }
}

}  // namespace
}  // namespace grainsweep
