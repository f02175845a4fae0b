#include <set>
#include <string>

#include <catch2/catch.hpp>

#include "tests/extremes/catalogue.hpp"

namespace grainsweep::extremes {
namespace {

std::string text_of(const Scene& scene, const Finding& finding) {
  const Answer* worst = worst_answer(finding);
  std::string text = scene.family + ": " + scene.name + " (" + scene.extreme + "; " +
                     scene.accuracy + "): " + name_of(outcome_of(finding)) + " " + finding.refusal +
                     finding.unrest;
  if (worst == nullptr) return text;
  return text + "\n" + worst->what + ": error " + std::to_string(worst->error) + ", tolerance " +
         std::to_string(worst->tolerance) + ", " + worst->reason;
}

/// Runs the scenes of a family: each keeps its own promise.
void check(const std::vector<Scene>& scenes) {
  for (const Scene& scene : scenes) {
    const Finding finding = scene.run();
    const Outcome outcome = outcome_of(finding);
    INFO(text_of(scene, finding));
    CHECK(keeps_promise(scene, outcome));
  }
}

TEST_CASE("no tower of grains carries wrong forces without a word") { check(towers()); }
TEST_CASE("no grain sinks through one of another mass without a word") { check(masses()); }
TEST_CASE("no odd start ends wrong without a word") { check(starts()); }
TEST_CASE("no step, tolerance or iteration count is wrong without a word") { check(accuracies()); }
TEST_CASE("no box and no number of grains is wrong without a word") { check(boxes()); }
TEST_CASE("the extreme sweeps of configs are right, refused or not settled") {
  check(sweep_files());
}
TEST_CASE("the unit of length does not matter") { check(units()); }
TEST_CASE("crystals, slabs, wedges and balanced beds have their exact answers") {
  check(exact_answers());
}
TEST_CASE("beds shifted, mirrored and renamed are the same beds") { check(symmetries()); }
TEST_CASE("the energy of a falling bed never rises") { check(energies()); }
TEST_CASE("what is no number is refused or fails by name") { check(not_numbers()); }
TEST_CASE("degenerate pairs of polyhedra have the gaps of brute force") {
  check(polyhedron_pairs());
}
TEST_CASE("stacks of plates stand, each carrying those above it") { check(stacks()); }

TEST_CASE("the catalogue has 150 scenes and more, each told apart from the others") {
  std::set<std::string> names;
  const std::vector<Scene> all = catalogue();
  for (const Scene& s : all) {
    CHECK(names.insert(s.family + s.name + s.extreme + s.accuracy).second);
  }
  CHECK(all.size() >= 150);
}

Finding finding_with(double error) {
  Finding finding;
  finding.answers = {{"an answer", error, 1.0, "for the test"}};
  return finding;
}

TEST_CASE("a finding is silently wrong if an answer is, and no word is said of it") {
  CHECK(outcome_of(finding_with(1.0)) == Outcome::right);
  CHECK(outcome_of(finding_with(1.1)) == Outcome::silently_wrong);
  CHECK(outcome_of(finding_with(std::stod("nan"))) == Outcome::silently_wrong);
  CHECK(outcome_of({}) == Outcome::silently_wrong);  // nothing was compared
  Finding finding = finding_with(1.1);
  finding.unrest = "it moves";
  CHECK(outcome_of(finding) == Outcome::not_settled);
  finding.refusal = "no room";
  CHECK(outcome_of(finding) == Outcome::refused);
  finding.finite = false;
  CHECK(outcome_of(finding) == Outcome::silently_wrong);
}

TEST_CASE("the worst answer is the one farthest beyond its tolerance") {
  Finding finding;
  finding.answers = {{"a", 0.5, 1.0, ""}, {"b", 3e-9, 1e-9, ""}, {"c", 0.0, 0.0, ""}};
  CHECK(worst_answer(finding)->what == "b");
  finding.answers.push_back({"d", std::stod("nan"), 1.0, ""});
  CHECK(worst_answer(finding)->what == "d");
  CHECK(worst_answer({}) == nullptr);
}

TEST_CASE("a promise is broken by silence, and by a known defect that is mended") {
  Scene scene;
  scene.expected = Outcome::not_settled;
  CHECK(keeps_promise(scene, Outcome::right));
  CHECK_FALSE(keeps_promise(scene, Outcome::silently_wrong));
  scene.expected = Outcome::right;
  CHECK_FALSE(keeps_promise(scene, Outcome::not_settled));
  scene.expected = Outcome::silently_wrong;
  CHECK_FALSE(keeps_promise(scene, Outcome::right));
}

}  // namespace
}  // namespace grainsweep::extremes
