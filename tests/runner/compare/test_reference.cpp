#include <catch2/catch.hpp>

#include "runner/compare/reference.hpp"
#include "runner/exit_codes.hpp"
#include "runner/store/files.hpp"
#include "tests/runner/sample_rows.hpp"
#include "tests/runner/temporary_folder.hpp"

namespace grainsweep {
namespace {

Reference reference_of(const std::string& text) {
  const TemporaryFolder folder;
  replace_file(folder.path() + "/r.json", text);
  return read_reference(folder.path() + "/r.json");
}

/// The one value of a reference that has no other.
Published value_of(const std::string& members) {
  return reference_of(R"({"source": "S", "common": [{)" + members + "}]}").common.at(0);
}

TEST_CASE("values, ranges, errors and words are read and printed as they were published") {
  const Published z = value_of(R"("quantity": "Z_unconfined", "value": 6.027, "error": 0.012)");
  CHECK(z.quantity == "Z_unconfined");
  CHECK(z.range->low == 6.027);
  CHECK(z.range->high == 6.027);
  CHECK(z.range->error == 0.012);
  CHECK(z.text == "6.027 ± 0.012");
  const Published reach =
      value_of(R"("quantity": "reach", "width": 10, "value": [3, 4], "definition": "by eye")");
  CHECK(reach.range->low == 3);
  CHECK(reach.range->high == 4);
  CHECK(reach.width == 10);
  CHECK(reach.text == "3 to 4");
  CHECK(reach.definition == "by eye");
  const Published about = value_of(R"("quantity": "C", "value": 0.2, "text": "about 0.2")");
  CHECK(about.text == "about 0.2");
  const Published words = value_of(R"("quantity": "C", "text": "falls")");
  CHECK_FALSE(words.range);
  CHECK(value_of(R"("quantity": "C")").text == "-");
}

TEST_CASE("what is wrong in a file of published values is told with its place") {
  const auto told = [](const std::string& text) -> std::string {
    try {
      reference_of(text);
    } catch (const BadInput& error) {
      return error.what();
    }
    return "";
  };
  const auto told_of = [&](const std::string& members) {
    return told(R"({"source": "S", "families": [{"where": {}, "values": [{)" + members + "}]}]}");
  };
  CHECK_THAT(told("{"), Catch::Contains("r.json") && Catch::Contains("parse error"));
  CHECK_THAT(told("{}"), Catch::Contains("'source' not found"));
  CHECK_THAT(told(R"({"source": "S", "famlies": []})"), Catch::Contains("\"families\"?"));
  CHECK_THAT(told_of(R"("quantity": "zet")"), Catch::Contains("/families/0: /values/0: unknown"));
  CHECK_THAT(told_of(R"("quantity": "C", "eror": 1)"), Catch::Contains("did you mean \"error\""));
  CHECK_THAT(told_of(R"("quantity": "C", "value": "1")"), Catch::Contains("must be number"));
  CHECK_THAT(told_of(R"("quantity": "C", "value": [1])"), Catch::Contains("out of range"));
  CHECK_THAT(told_of(R"("quantity": "C", "value": [2, 1])"), Catch::Contains("[low, high]"));
}

TEST_CASE("values belong to the families whose parameters are those of `where`") {
  const auto describes_it = [](const std::string& where, const std::string& parameters) {
    return describes(
        reference_of(R"({"source": "S", "families": [{"where": )" + where + "}]}").families.at(0),
        parameters);
  };
  const std::string spheres = sample_parameters(5, Boundary::walls, 0.4);
  CHECK(describes_it("{}", spheres));
  CHECK(describes_it(R"({"shape": "sphere", "sizes.small_share": 0.4})", spheres));
  CHECK_FALSE(describes_it(R"({"shape": "sphere", "sizes.small_share": 0.5})", spheres));
  CHECK_FALSE(describes_it(R"({"shape": "pinacoid"})", spheres));
  const std::string pinacoids = R"({"shape":{"pinacoid":{"angle_deg":60,"height":1}}})";
  CHECK(describes_it(R"({"shape.pinacoid.angle_deg": 60.0})", pinacoids));
  CHECK_FALSE(describes_it(R"({"shape.pinacoid.angle_deg": 50})", pinacoids));
  CHECK_FALSE(describes_it(R"({"shape.pinacoid.angle_deg": 60})", spheres));
}

TEST_CASE("published values lie beside their sweep") {
  CHECK(reference_beside("configs/paper.json") == "configs/paper.reference.json");
  CHECK(reference_beside("paper") == "paper.reference.json");
}

}  // namespace
}  // namespace grainsweep
