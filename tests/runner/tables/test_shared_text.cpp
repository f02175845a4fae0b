#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "runner/tables/job_facts.hpp"
#include "tests/runner/sample_rows.hpp"

namespace grainsweep {
namespace {

TEST_CASE("copies of a text share it until one of them is replaced") {
  const SharedText text = std::string("a text longer than a string keeps in itself");
  SharedText copy = text;
  CHECK(copy.text().data() == text.text().data());
  copy = "another";
  CHECK(copy.text() == "another");
  CHECK(text.text() == "a text longer than a string keeps in itself");
  CHECK_FALSE(copy == text);
}

TEST_CASE("texts are equal by what they say, none is an empty one") {
  CHECK(SharedText("one") == SharedText("one"));
  CHECK(SharedText() == SharedText(""));
  CHECK(SharedText().text().empty());
}

TEST_CASE("rows of equal parameters share their text") {
  std::vector<Row> rows;
  for (const double width : {4.0, 5.0}) {
    for (const int replicate : {1, 2}) {
      rows.push_back({sample_job(std::to_string(rows.size()), width, replicate), std::nullopt});
    }
  }
  const std::vector<Row> back = rows_of(job_list(rows));
  REQUIRE(back.size() == 4);
  CHECK(&back[0].job.parameters.text() == &back[1].job.parameters.text());
  CHECK(&back[2].job.parameters.text() == &back[3].job.parameters.text());
  CHECK_FALSE(back[1].job.parameters == back[2].job.parameters);
}

}  // namespace
}  // namespace grainsweep
