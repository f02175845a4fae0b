// All extreme scenes of tests/extremes as a Markdown table.
//
//   bench_extremes [FAMILY] > extremes.md        progress goes to standard error
#include <cstdio>
#include <string>
#include <vector>

#include "tests/extremes/catalogue.hpp"

namespace grainsweep::extremes {
namespace {

/// What is printed about the error: of the answer nearest to its tolerance, or why there is none.
std::string error_text(const Finding& finding) {
  if (!finding.refusal.empty()) return finding.refusal;
  if (!finding.unrest.empty()) return finding.unrest;
  const Answer* worst = worst_answer(finding);
  if (worst == nullptr) return "no answer";
  char numbers[64];
  std::snprintf(numbers, sizeof numbers, ": %.1e of %.1e", worst->error, worst->tolerance);
  return worst->what + numbers;
}

/// Runs and prints one scene; whether it is silently wrong.
bool print_row(const Scene& scene) {
  std::fprintf(stderr, "%s: %s, %s\n", scene.family.c_str(), scene.name.c_str(),
               scene.accuracy.c_str());
  const Finding finding = scene.run();
  const Outcome outcome = outcome_of(finding);
  std::printf("| %s | %s | %s | %s | %s |\n", scene.name.c_str(), scene.extreme.c_str(),
              scene.accuracy.c_str(), name_of(outcome), error_text(finding).c_str());
  std::fflush(stdout);
  return outcome == Outcome::silently_wrong;
}

}  // namespace
}  // namespace grainsweep::extremes

int main(int argc, char** argv) {
  using namespace grainsweep::extremes;
  const std::string family = argc > 1 ? argv[1] : "";
  int wrong = 0;
  std::printf(
      "| scene | what is extreme | accuracy | outcome | error of tolerance, or reason |\n"
      "|---|---|---|---|---|\n");
  for (const Scene& scene : catalogue()) {
    if (family.empty() || scene.family == family) wrong += print_row(scene) ? 1 : 0;
  }
  std::fprintf(stderr, "%d silently wrong\n", wrong);
  return wrong == 0 ? 0 : 1;
}
