#include <set>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "runner/sweep/identity.hpp"
#include "tests/runner/sweep/sweep_files.hpp"

namespace grainsweep {
namespace {

std::vector<std::string> ids_of(const std::string& text) {
  std::vector<std::string> ids;
  for (const Job& job : jobs_of(text)) ids.push_back(job.id);
  return ids;
}

const std::string golden_base = R"({
  "box": {"length": 20, "width": 5, "x": "periodic", "y": "walls"}, "fill": {"grains": 1000},
  "sizes": {"spread": 0.03, "small_share": 0, "size_ratio": 0.5}})";

}  // namespace

TEST_CASE("ids and random keys never change from version to version") {
  const std::uint64_t hash = JobHash(R"({"box":{"width":5}})")(20130708, 3);
  CHECK(hex16(hash) == "ecdadefd36a7056b");
  CHECK(hex16(JobHash(R"({"box":{)").followed_by(R"("width":5}})")(20130708, 3)) ==
        "ecdadefd36a7056b");
}

TEST_CASE("an id is the hash of parameters, seed and replicate") {
  for (const Job& job : jobs_of(R"({"name": "t", "seed": 9, "replicates": 2})")) {
    const std::uint64_t hash = JobHash(job.parameters.text())(job.seed, job.replicate);
    CHECK(job.seed == 9);
    CHECK(job.id == hex16(hash));
  }
}

TEST_CASE("packings of one scene, seed and replicate start alike at every accuracy") {
  const std::vector<Job> jobs = jobs_of(sweep_of(R"({"grid": {
    "accuracy": ["fast", "balanced", {"preset": "accurate", "precision": "f64"}]}},
    {"set": {"measure.exclude_floor": 2}})"));
  REQUIRE(jobs.size() == 4);
  std::set<std::string> ids;
  for (const Job& job : jobs) {
    CHECK(job.spec.random_key == jobs[0].spec.random_key);
    ids.insert(job.id);
  }
  CHECK(ids.size() == 4);
}

TEST_CASE("packings have a bed in common if they differ in what is measured alone") {
  const std::vector<Job> jobs = jobs_of(sweep_of(R"({}, {"set": {"measure": {"bin_width": 0.3,
    "exclude_floor": 2, "exclude_surface": 1, "gap_tolerances": [1e-3]}}})"));
  REQUIRE(jobs.size() == 2);
  CHECK(jobs[0].id != jobs[1].id);
  CHECK(jobs[0].bed == jobs[1].bed);
  const auto bed = [](const std::string& text) { return jobs_of(text).back().bed; };
  const std::set<std::uint64_t> beds = {
      bed(R"({"name": "t"})"),
      bed(R"({"name": "t", "seed": 1})"),
      bed(R"({"name": "t", "replicates": 2})"),
      bed(R"({"name": "t", "base": {"shape": "pinacoid"}})"),
      bed(R"({"name": "t", "base": {"box.width": 10.5}})"),
      bed(R"({"name": "t", "base": {"accuracy": "fast"}})"),
      bed(R"({"name": "t", "base": {"accuracy.precision": "f64"}})"),
  };
  CHECK(beds.size() == 7);
}

TEST_CASE("packings that settle have a bed in common if they differ in max_steps alone") {
  const std::vector<Job> jobs = jobs_of(sweep_of(R"({"set": {"accuracy.max_steps": 5000}},
    {"set": {"accuracy.max_steps": 6000}}, {"set": {"accuracy.step": 0.1}})"));
  REQUIRE(jobs.size() == 3);
  CHECK(jobs[0].bed != jobs[1].bed);
  CHECK(jobs[0].settled_bed == jobs[1].settled_bed);
  CHECK(jobs[0].settled_bed != jobs[2].settled_bed);
}

TEST_CASE("every parameter of the scene, seed and replicate change where a packing starts") {
  const auto key = [](const std::string& text) { return jobs_of(text).back().spec.random_key; };
  const std::set<std::uint64_t> keys = {
      key(R"({"name": "t"})"),
      key(R"({"name": "t", "seed": 1})"),
      key(R"({"name": "t", "replicates": 2})"),
      key(R"({"name": "t", "base": {"shape": "pinacoid"}})"),
      key(R"({"name": "t", "base": {"box.width": 10.5}})"),
      key(R"({"name": "t", "base": {"fill.solid_height": 9}})"),
      key(R"({"name": "t", "base": {"sizes.spread": 0.1}})"),
  };
  CHECK(keys.size() == 7);
}

TEST_CASE("canonical parameters are valid JSON with sorted keys and short numbers") {
  const auto jobs = jobs_of(R"({"name": "t", "base": )" + golden_base + "}");
  REQUIRE(jobs.size() == 1);
  const std::string& text = jobs[0].parameters.text();
  auto canonical = nlohmann::json::parse(text);
  CHECK(canonical.erase("accuracy") == 1);
  CHECK(text.starts_with(R"({"accuracy":{"contact_tolerance":)"));
  CHECK(text.ends_with(
      R"(},"box":{"length":20,"width":5,"x":"periodic","y":"walls"},"fill":{"grains":1000},)"
      R"("measure":{"bin_width":0.1,"exclude_floor":3,"exclude_surface":3,"gap_tolerances":[1e-04,1e-05,0.001,0.006]},)"
      R"("shape":"sphere","sizes":{"size_ratio":0.5,"small_share":0,"spread":0.03}})"));
  CHECK(canonical.at("box").at("width") == 5.0);
  CHECK(canonical.size() == 5);
}

TEST_CASE("the ids of spheres stay what they are") {
  // All that an id depends on is written out: no default or preset can move it.
  CHECK(ids_of(R"({"name": "t", "seed": 0, "base": {
    "accuracy": {"contact_tolerance": 0.025, "creep_steps": 45, "fall_iterations": 40,
      "imbalance_gap": 1e-4, "imbalance_tolerance": 0.02, "kinetic_tolerance": 1e-4, "max_steps": 2000, "momentum": 0.9,
      "overlap_tolerance": 1e-5, "path_tolerance": 1e-4, "precision": "f32", "protocol": "heavy_ball",
      "residual_tolerance": 0.01, "rest": "in_steps", "rest_iterations": 300, "solver": "apgs", "step": 0.2},
    "box": {"length": 20, "width": 5, "x": "periodic", "y": "walls"}, "fill": {"grains": 1000},
    "measure": {"bin_width": 0.1, "exclude_floor": 3, "exclude_surface": 3,
      "gap_tolerances": [1e-4, 1e-5, 1e-3, 6e-3]}, "shape": "sphere",
    "sizes": {"size_ratio": 0.5, "small_share": 0, "spread": 0.03}}})")
            .at(0) == "791de99a13b2deb5");
}

TEST_CASE("canonical parameters of other shapes are groups, a hull that of a hash") {
  const auto shape = [](const std::string& base) {
    const auto jobs = jobs_of(R"({"name": "t", "base": {"shape": )" + base + "}}");
    const std::string text = jobs.at(0).parameters.text();
    CHECK(nlohmann::json::parse(text).size() == 6);
    const std::size_t at = text.find("\"shape\":");
    return text.substr(at, text.find(",\"sizes\"") - at);
  };
  CHECK(shape("\"pinacoid\"") ==
        R"("shape":{"pinacoid":{"angle_deg":60,"height":1,"length":1,"width":1}})");
  CHECK(shape(R"({"pinacoid": {"angle_deg": 52.5}})") ==
        R"("shape":{"pinacoid":{"angle_deg":52.5,"height":1,"length":1,"width":1}})");
  CHECK(shape("\"cube\"") == R"("shape":{"cube":{"edge":1}})");
  CHECK(shape(R"({"octahedron": {}})") == R"("shape":{"octahedron":{"height":1}})");
  CHECK(shape(R"({"prism": {"sides": 8}})") ==
        R"("shape":{"prism":{"diameter":1,"height":1,"sides":8}})");
  CHECK(shape("\"cylinder\"") ==
        R"("shape":{"cylinder":{"chord_error":0.01,"diameter":1,"height":1}})");
  const HullVertices corner{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  CHECK(shape(R"({"hull": {"vertices": [[0,0,-0.0],[1,0,0],[0,1,0],[0,0,1]]}})") ==
        R"("shape":{"hull":{"vertices":")" + hash_of(corner) + "\"}}");
}

TEST_CASE("hulls keep their hash from version to version") {
  CHECK(hash_of({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0.1}}}) == "7e8fec29dfd103bd");
}

TEST_CASE("every part of the accuracy belongs to the identity, the preset's name does not") {
  const auto accuracy = [](const std::string& text) {
    return nlohmann::json::parse(jobs_of(text).at(0).parameters.text()).at("accuracy");
  };
  const auto balanced = accuracy(R"({"name": "t"})");
  CHECK(balanced == accuracy(R"({"name": "t", "base": {"accuracy": "balanced"}})"));
  CHECK(balanced.count("preset") == 0);
  CHECK(balanced.at("solver").is_string());
  const std::map<std::string, std::string> other_names = {
      {"protocol", "dynamic"}, {"solver", "pgs"}, {"precision", "f64"}, {"rest", "exact"}};
  for (const auto& [part, value] : balanced.items()) {
    const nlohmann::json other =
        value.is_string() ? nlohmann::json(other_names.at(part))
                          : nlohmann::json(value.is_number_integer() ? value.get<int>() + 1
                                                                     : value.get<double>() / 2);
    INFO(part);
    CHECK(accuracy(R"({"name": "t", "base": {"accuracy": {")" + part + "\": " + other.dump() +
                   "}}}") != balanced);
  }
}

TEST_CASE("labels, the order of keys and how numbers are written do not enter an id") {
  const auto ids = ids_of(R"({"name": "t", "seed": 5, "replicates": 2,
    "base": {"box": {"width": 5, "length": 10}, "fill": {"solid_height": 4}},
    "sweep": [{"label": "a", "grid": {"box.y": ["walls", "periodic"]}}]})");
  REQUIRE(ids.size() == 4);
  CHECK(ids == ids_of(R"({"replicates": 2, "sweep": [{"grid": {"box.y": ["walls", "periodic"]},
    "label": "b"}], "base": {"fill.solid_height": 4.0, "box": {"length": 1e1, "width": 5.0}},
    "seed": 5, "name": "other"})"));
}

TEST_CASE("what a sweep says of its units does not enter an id") {
  CHECK(ids_of(R"({"name": "t"})") ==
        ids_of(R"({"name": "t", "units": {"d": 3.2, "unit": "mm", "density": 2500}})"));
}

TEST_CASE("writing a default out does not change an id") {
  CHECK(ids_of(R"({"name": "t"})") ==
        ids_of(R"({"name": "t", "base": {"box.y": "walls", "accuracy": "balanced"}})"));
}

TEST_CASE("parameters, seed and replicate each change the id") {
  const std::set<std::string> ids = {
      ids_of(R"({"name": "t"})").at(0),
      ids_of(R"({"name": "t", "seed": 1})").at(0),
      ids_of(R"({"name": "t", "replicates": 2})").at(1),
      ids_of(R"({"name": "t", "base": {"box.width": 10.000000001}})").at(0),
  };
  CHECK(ids.size() == 4);
  CHECK(ids_of(R"({"name": "t", "replicates": 2})").at(0) == ids_of(R"({"name": "t"})").at(0));
}

TEST_CASE("adding, editing and moving blocks leaves the ids of other blocks as they are") {
  const std::string block = R"({"label": "w", "grid": {"box.width": [4, 5, 6]}})";
  const auto ids = ids_of(sweep_of(block));
  REQUIRE(ids.size() == 3);
  auto after = ids_of(sweep_of(R"({"label": "x", "set": {"box.length": 12}}, )" + block));
  REQUIRE(after.size() == 4);
  after.erase(after.begin());
  CHECK(after == ids);
}

TEST_CASE("one flipped bit changes about half of the bits of an id") {
  const auto distance = [](std::uint64_t a, std::uint64_t b) {
    return __builtin_popcountll(a ^ b);
  };
  int total = 0;
  for (int replicate = 1; replicate <= 1000; ++replicate) {
    total += distance(JobHash("{}")(0, replicate), JobHash("{}")(0, replicate + 1));
  }
  CHECK(std::abs(total / 1000.0 - 32.0) < 1.0);  // eight standard deviations of the mean
}

}  // namespace grainsweep
