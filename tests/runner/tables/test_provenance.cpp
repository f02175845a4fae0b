#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "runner/tables/provenance.hpp"
#include "tests/runner/sample_rows.hpp"

namespace grainsweep {
namespace {

Provenance sample_provenance() {
  Provenance provenance;
  provenance.build = {"1.2.3", "g++ 12", {{"oneTBB", "2021.8"}}};
  provenance.sweep_file = "configs/a.json";
  provenance.sweep_text_hash = text_hash("text");
  provenance.sweep_name = "a";
  provenance.runs = {{"2026-01-01T00:00:00Z", "2026-01-01T00:00:02Z", 2.0, "h-1", 2, "avx2", 1},
                     {"2026-01-02T00:00:00Z", "", 0.0, "h-2", 8, "sse2", 0}};
  return provenance;
}

TEST_CASE("provenance reads back as it was written") {
  const std::vector<Row> rows = {{sample_job("a1", 5), {}}, {sample_job("a2", 6), {}}};
  const std::string text = provenance_text(sample_provenance(), rows);
  const auto [back, jobs] = provenance_from_text(text);
  CHECK(provenance_text(back, jobs) == text);
  REQUIRE(back.runs.size() == 2);
  CHECK(back.runs[0].threads == 2);
  CHECK(back.runs[0].wall_seconds == 2.0);
  CHECK(back.runs[1].ended.empty());
  CHECK(jobs.at(1).job.box.width == 6);
  CHECK(back.sweep_name == "a");
  CHECK(back.build.libraries.at("oneTBB") == "2021.8");
}

TEST_CASE("of a summary the jobs are known by their ids") {
  const std::vector<Row> rows = {{sample_job("a1", 5), {}}};
  const auto [back, jobs] =
      provenance_from_text(provenance_text(sample_provenance(), rows), Detail::summary);
  CHECK(back.sweep_file == "configs/a.json");
  CHECK(jobs.at(0).job.id == "a1");
  CHECK(jobs.at(0).job.parameters.empty());
}

TEST_CASE("provenance carries the totals of the packings") {
  Row pending = settled_row("a2", 6, 0.6, 6);
  pending.outcome.reset();
  const auto json = nlohmann::json::parse(provenance_text(
      sample_provenance(), {settled_row("a1", 5, 0.6, 6), pending,
                            row_with_status("a3", 6, PackingStatus::failed, "no room")}));
  CHECK(json.at("totals") == nlohmann::json{{"packings", 3},
                                            {"settled", 1},
                                            {"not_settled", 0},
                                            {"failed", 1},
                                            {"pending", 1},
                                            {"cpu_seconds", 1.5}});
}

TEST_CASE("the hash of a text says what it is") {
  CHECK(text_hash("foobar") == "fnv1a64:85944171f73967e8");
}

}  // namespace
}  // namespace grainsweep
