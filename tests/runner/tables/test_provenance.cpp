#include <filesystem>
#include <string>
#include <utility>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "runner/hash.hpp"
#include "runner/tables/provenance.hpp"
#include "tests/runner/sample_rows.hpp"

namespace grainsweep {
namespace {

Provenance sample_provenance() {
  Provenance provenance;
  provenance.build = {"1.2.3", "0123abc", "g++ 12", {{"oneTBB", "2021.8"}}};
  provenance.sweeps = {{"configs/a.json", "{\n \"name\": \"a\" }"}};
  provenance.sweep_name = "a";
  provenance.runs = {{"2026-01-01T00:00:00Z", "2026-01-01T00:00:02Z", 2.0, "h-1", 2, "avx2", 1,
                      "grainsweep run configs/a.json", "h", "a processor", 4, "0123abc"},
                     {"2026-01-02T00:00:00Z", "", 0.0, "h-2", 8, "sse2", 0, "", "", "", 0, ""}};
  return provenance;
}

TEST_CASE("provenance reads back as it was written") {
  const std::vector<Row> rows = {{sample_job("a1", 5), {}}, {sample_job("a2", 6), {}}};
  const std::string text = provenance_text(sample_provenance(), rows);
  const auto [back, list] = provenance_from_text(text);
  const std::vector<Row> jobs = rows_of(list);
  CHECK(provenance_text(back, jobs) == text);
  auto as_json = nlohmann::ordered_json::parse(text);
  const auto entries = std::exchange(as_json["sweep"]["jobs"], nlohmann::json::array());
  std::string with_a_line_each = as_json.dump(2) + "\n";
  const std::string before = "\"jobs\": [";
  with_a_line_each.insert(
      with_a_line_each.find(before) + before.size(),
      "\n      " + entries[0].dump() + ",\n      " + entries[1].dump() + "\n    ");
  CHECK(with_a_line_each == text);
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
  const auto [back, list] = provenance_from_text(provenance_text(sample_provenance(), rows));
  const std::vector<Row> jobs = rows_of(list, Detail::summary);
  CHECK(sweep_file_of(back) == "configs/a.json");
  CHECK(jobs.at(0).job.id == "a1");
  CHECK(jobs.at(0).job.parameters.text().empty());
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

TEST_CASE("the sweep file is kept verbatim; of several none is the one to go on with") {
  Provenance provenance = sample_provenance();
  provenance = provenance_from_text(provenance_text(provenance, {})).provenance;
  CHECK(provenance.sweeps.at(0).text == "{\n \"name\": \"a\" }");
  CHECK(provenance.runs.at(0).command == "grainsweep run configs/a.json");
  CHECK(provenance.runs.at(0).processor == "a processor");
  provenance.sweeps.push_back({"b.json", "{}"});
  CHECK(sweep_file_of(provenance).empty());
}

TEST_CASE("a sweep file that was given in another folder is found from here") {
  Provenance provenance;
  const std::filesystem::path here = std::filesystem::current_path();
  provenance.sweeps = {{"a/../b.json", "{}", here.string()}};
  CHECK(sweep_file_of(provenance) == "a/../b.json");
  provenance.sweeps[0].folder = (here / "in").string();
  CHECK(sweep_file_of(provenance) == "in/b.json");
  provenance.sweeps[0].file = "/c.json";
  CHECK(sweep_file_of(provenance) == "/c.json");
}

TEST_CASE("the units of a sweep are kept, and none where it has none") {
  Provenance provenance = sample_provenance();
  CHECK_FALSE(provenance_from_text(provenance_text(provenance, {})).provenance.units);
  for (const Units& units : {Units{3.2, "mm", 2500.0}, Units{450, "um", std::nullopt}}) {
    provenance.units = units;
    CHECK(provenance_from_text(provenance_text(provenance, {})).provenance.units == units);
  }
}

TEST_CASE("a job of no known parameter set is refused") {
  std::string text = provenance_text(sample_provenance(), {{sample_job("a1", 5), {}}});
  const std::string set = "\"set\":0", before = ",\n  \"crc32\": \"";
  text.replace(text.find(set), set.size(), "\"set\":1");
  const std::string checked = text.substr(0, text.rfind(before));
  const std::string sealed = checked + before + hex8(crc32(checked)) + "\"\n}\n";
  CHECK_THROWS_WITH(provenance_from_text(sealed), Catch::Contains("no such parameter set"));
}

TEST_CASE("provenance with any byte changed is refused") {
  const std::string text = provenance_text(sample_provenance(), {{sample_job("a1", 5), {}}});
  for (std::size_t at = 0; at < text.size(); ++at) {
    std::string changed = text;
    changed[at] = static_cast<char>(changed[at] ^ 1);
    CHECK_THROWS_AS(provenance_from_text(changed), nlohmann::json::exception);
  }
  CHECK_THROWS_AS(provenance_from_text(text + " "), nlohmann::json::exception);
}

}  // namespace
}  // namespace grainsweep
