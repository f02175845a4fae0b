#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "runner/report/bed_view.hpp"
#include "runner/report/html.hpp"
#include "tests/runner/sample_rows.hpp"

using namespace grainsweep;

namespace {

StoredBed two_spheres() {
  StoredBed bed;
  bed.box.length = 4.0;
  bed.box.width = 2.0;
  bed.grains = {{1.0, 1.0, 0.5, 0.5, 2.0, 3}, {4.0, 2.0, 1.25, 0.25, 1.0, 300}};
  return bed;
}

/// What stands between the tags of the element.
nlohmann::json json_in(const std::string& element) {
  const std::size_t start = element.find('>') + 1;
  return nlohmann::json::parse(element.substr(start, element.rfind("</script>") - start));
}

std::string shorts(const std::vector<unsigned>& numbers) {
  std::string bytes;
  for (const unsigned number : numbers) {
    bytes += static_cast<char>(number & 0xFFu);
    bytes += static_cast<char>(number >> 8u);
  }
  return bytes;
}

}  // namespace

TEST_CASE("the grains of a bed are columns of 16 bits, as shares of the largest", "[report]") {
  const nlohmann::json json = json_in(bed_element(two_spheres(), {"a bed", 0.0}));
  CHECK(json["count"] == 2);
  CHECK(json["extent"] == 4.0);
  CHECK(json["box"][2] == 1.5);
  CHECK(json["grains"] == base64(shorts({16384, 65535, 16384, 32768, 8192, 20480, 65535, 32768,
                                         65535, 32768, 3, 300})));
  CHECK(json["walls"] == nlohmann::json::parse("[false, true]"));
  CHECK_FALSE(json.contains("meshes"));
}

TEST_CASE("a bed of polyhedra has its mesh and an orientation for each grain", "[report]") {
  StoredBed bed = two_spheres();
  bed.turned = sample_turned();
  const nlohmann::json json = json_in(bed_element(bed, {"a bed", 0.0}));
  CHECK(json["meshes"][0]["vertices"].size() == 4);
  CHECK(json["meshes"][0]["faces"].size() == 4);
  const std::string text = json["grains"];
  const std::string turns = base64(shorts({0, 0, 0, 32767, 19660, 0, 0, 26214}));
  CHECK(text.substr(32) == turns);  // 24 bytes before, a multiple of 3
  CHECK(view_size(bed) > view_size(two_spheres()));
}

TEST_CASE("a bed of a mixture has all meshes, and the component of each grain behind the rest",
          "[report]") {
  StoredBed bed = two_spheres();
  bed.turned = sample_turned();
  const std::size_t of_one = view_size(bed);
  bed.turned->meshes.push_back(bed.turned->meshes.front());
  bed.turned->components = {1, 0};
  const nlohmann::json json = json_in(bed_element(bed, {"a bed", 0.0}));
  CHECK(json["meshes"].size() == 2);
  const std::string text = json["grains"];
  const std::string ends = base64(shorts({0, 0, 0, 32767, 19660, 0, 0, 26214, 1, 0}));
  CHECK(text.substr(32) == ends);
  CHECK(view_size(bed) > of_one);
}

TEST_CASE("the forces between grains are pairs of their numbers and shares of the largest",
          "[report]") {
  StoredBed bed = two_spheres();
  CHECK(json_in(bed_element(bed, {"a bed", 0.0}))["pairs"] == 0);
  const std::size_t without = view_size(bed);
  bed.forces = {{0, 1, 2.5}, {70000, 1, 5.0}};
  const nlohmann::json json = json_in(bed_element(bed, {"a bed", 0.0}));
  CHECK(json["pairs"] == 2);
  CHECK(json["largest_pair_force"] == 5.0);
  CHECK(json["forces"] == base64(shorts({0, 0, 4464, 1, 1, 0, 1, 0, 32768, 65535})));
  CHECK(view_size(bed) > without);
}

TEST_CASE("lengths are told in the unit of the sweep, if it has one", "[report]") {
  CHECK(json_in(bed_element(two_spheres(), {"a bed", 0.0}))["unit"] == "d");
  const Units units{450, "um", std::nullopt};
  const nlohmann::json json = json_in(bed_element(two_spheres(), {"a bed", 0.0, units}));
  CHECK(json["unit"] == "µm");
  CHECK(json["d"] == 450.0);
}

TEST_CASE("below the picture stands what its colours are", "[report]") {
  StoredBed bed = two_spheres();
  const BedFacts in_mm{"a bed", 0.0, Units{3.2, "mm", std::nullopt}};
  CHECK_THAT(picture_key(bed, {"a bed", 0.0}),
             Catch::StartsWith("0.5 d<span") && Catch::EndsWith("</span>1 d") &&
                 Catch::Contains("linear-gradient(to right,rgb(68,1,84),"));
  CHECK_THAT(picture_key(bed, in_mm), Catch::EndsWith("</span>3.2 mm"));
  bed.grains[1].radius = 0.5;
  CHECK(picture_key(bed, {"a bed", 0.0}) ==
        "<span class=\"scale square\" style=\"background:rgb(33,145,140)\"></span>all 1 d");
  bed.grains.clear();
  CHECK(picture_key(bed, in_mm).empty());
}

TEST_CASE("components of a mixture are called by their shapes", "[report]") {
  StoredBed bed = two_spheres();
  bed.turned = sample_turned();
  bed.turned->meshes.push_back(bed.turned->meshes.front());
  bed.turned->components = {1, 0};
  const BedFacts facts = facts_of(mixture_row("a", 4).job, "a bed");
  CHECK(json_in(bed_element(bed, facts))["components"] ==
        nlohmann::json::parse(R"(["cube", "sphere"])"));
  CHECK_THAT(picture_key(bed, facts), Catch::Contains("rgb(0,114,178)\"></span>cube") &&
                                          Catch::Contains("rgb(230,159,0)\"></span>sphere"));
}

TEST_CASE("a page that has not all beds says so", "[report]") {
  const std::string text = " Beds of 2 of 16 parameter sets are here.";
  CHECK_THAT(bed_section({"a", "", "", {"", ""}, 16}), Catch::Contains(text));
  CHECK_THAT(bed_section({"a", "", "", {"", ""}, 2}), !Catch::Contains("parameter sets"));
}

TEST_CASE("a bed's title cannot end its element", "[report]") {
  const std::string element = bed_element(two_spheres(), {"\"></script><b>", 0.0});
  CHECK(element.find("</script>") == element.rfind("</script>"));
  CHECK(element.find("<b>") == std::string::npos);
}

TEST_CASE("grains are of two kinds where a share of them is small", "[report]") {
  JobFacts job = sample_job("a", 4, 1, Boundary::walls, 0.4);
  CHECK(facts_of(job, "").small_limit == Approx(0.5 / 1.5));  // between 0.25 and 0.5 d
  CHECK(facts_of(sample_job("b", 4), "").small_limit == 0.0);
  job.small_share = 1.0;
  CHECK(facts_of(job, "").small_limit == 0.0);
}

TEST_CASE("the page of a bed holds it, a picture, and what turns it", "[report]") {
  const std::string page = bed_page(two_spheres(), {"a < b", 0.0});
  CHECK(page.find("<h1>a &lt; b</h1>") != std::string::npos);
  CHECK(page.find("src=\"data:image/png;base64,") != std::string::npos);
  CHECK(page.find("class=\"bed-data\"") != std::string::npos);
  CHECK(page.find("THREE") != std::string::npos);
}

// 8 MB is what mail takes; figures and tables come to 2 MB.
TEST_CASE("30,000 spheres, and 15,000 polyhedra, with their forces have room in a page",
          "[report]") {
  StoredBed bed;
  bed.box.length = bed.box.width = 25.0;
  for (int i = 0; i < 30000; ++i) {
    const double x = i % 25 + 0.5, y = i / 25 % 25 + 0.5, z = i / 625 + 0.5;
    bed.grains.push_back({x, y, z, 0.5, 1.0 + i % 7, 6});
    for (const int next : {1, 25, 625}) {
      bed.forces.push_back({i, (i + next) % 30000, 1.0 + i % 5});
    }
  }
  CHECK(bed_page(bed, {"spheres", 0.0}).size() < 6'000'000);
  bed.grains.resize(15000);
  bed.forces.resize(60000);
  for (PairForce& force : bed.forces) force.a %= 15000, force.b %= 15000;
  bed.turned = sample_turned();
  bed.turned->orientations.assign(15000, {0.6, 0.0, 0.0, 0.8});
  CHECK(bed_page(bed, {"polyhedra", 0.0}).size() < 6'000'000);
}
