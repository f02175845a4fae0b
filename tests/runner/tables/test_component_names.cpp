#include <catch2/catch.hpp>

#include "runner/tables/component_names.hpp"

namespace grainsweep {
namespace {

using Names = std::vector<std::string>;

/// A job with these components, the first of which has the number 1.
JobFacts job_of(const std::vector<std::string>& components) {
  JobFacts job;
  job.shape = "mixture";
  std::string text;
  for (const std::string& one : components) {
    text += (text.empty() ? "\"" : ",\"") + std::to_string(&one - components.data() + 1) + "\":{" +
            one + R"(,"share":0.25})";
  }
  job.parameters = R"({"shape":{"mixture":{)" + text + R"(},"mixture_by":"volume"}})";
  return job;
}

TEST_CASE("components are called by their shapes") {
  CHECK(component_names(
            job_of({R"("sphere":{})", R"("cylinder":{"chord_error":0.02,"height":1})"})) ==
        Names{"sphere", "cylinder"});
  const Names eleven = component_names(job_of(std::vector<std::string>(11, R"("sphere":{})")));
  CHECK((eleven.size() == 11 && eleven[10] == "sphere (11)"));
}

TEST_CASE("components of one shape are told apart by what differs, else by their number") {
  CHECK(component_names(
            job_of({R"("cuboid":{"height":1,"length":2,"width":1})", R"("cube":{"edge":1})",
                    R"("cuboid":{"height":0.5,"length":3,"width":1})"})) ==
        Names{"cuboid (height 1, length 2)", "cube", "cuboid (height 0.5, length 3)"});
  CHECK(component_names(job_of(
            {R"("prism":{"sides":3})", R"("prism":{"sides":5})", R"("prism":{"sides":3})"})) ==
        Names{"prism (1)", "prism (sides 5)", "prism (3)"});
}

TEST_CASE("hulls are told apart by the files of their vertices, not by hashes") {
  JobFacts job = job_of({R"("hull":{"vertices":"1f"})", R"("hull":{"vertices":"2f"})"});
  CHECK(component_names(job) == Names{"hull (1)", "hull (2)"});
  job.files = {{"shape.mixture.1.hull.vertices", "roof.obj"},
               {"shape.mixture.2.hull.vertices", "a,b.stl"}};
  CHECK(component_names(job) == Names{"hull (vertices roof.obj)", "hull (vertices a,b.stl)"});
}

TEST_CASE("grains of one shape have no components to name") {
  JobFacts job;
  job.parameters = R"({"shape":"sphere"})";
  CHECK(component_names(job).empty());
}

TEST_CASE("a share tells its component") {
  CHECK(component_of_share("shape.mixture.12.share") == 12);
  CHECK(component_of_share("shape.mixture.1.cube.edge") == 0);
  CHECK(component_of_share("sizes.small_share") == 0);
}

}  // namespace
}  // namespace grainsweep
