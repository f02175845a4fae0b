#include <string>

#include "runner/sweep/read_sweep.hpp"
#include "tests/extremes/catalogue.hpp"
#include "tests/extremes/packed.hpp"

namespace grainsweep::extremes {

namespace {

const std::string folder = GRAINSWEEP_CONFIGS "/extremes/";

/// The jobs that do not come out right, by label; what they promise instead.
Outcome expected_of(const std::string& label) {
  for (const char* text : {"300 d high", "W = d", "at its loosest"}) {
    if (label.starts_with(text)) return Outcome::not_settled;
  }
  return Outcome::right;
}

/// A scene for every job of a sweep file that can be run; what is extreme is the job's label.
void add_jobs(const std::string& file, std::vector<Scene>& scenes) {
  const SweepReading reading = read_sweep(folder + file);
  for (const Job& job : reading.sweep.jobs) {
    scenes.push_back({"sweep files", "configs/extremes/" + file, job.label, "as in the file",
                      expected_of(job.label), [spec = job.spec] { return pack(spec); }});
  }
  if (reading.errors.empty()) return;
  scenes.push_back({"sweep files", "configs/extremes/" + file, "cannot be read", "as in the file",
                    Outcome::right,
                    [why = reading.errors.front().message] { return Finding{why}; }});
}

/// A sweep file that must be refused, with the place of the first error.
Scene refused_file(const std::string& file, const std::string& extreme) {
  return {
      "sweep files", "configs/extremes/" + file, extreme, "as in the file", Outcome::refused, [=] {
        const SweepReading reading = read_sweep(folder + file);
        Finding finding;
        if (reading.errors.empty()) return finding;
        const Diagnostic& first = reading.errors.front();
        finding.refusal = first.pointer + " " + first.message;
        return finding;
      }};
}

}  // namespace

std::vector<Scene> sweep_files() {
  std::vector<Scene> scenes;
  for (const char* file : {"sizes.json", "heights.json", "layers.json", "accuracies.json"}) {
    add_jobs(file, scenes);
  }
  scenes.push_back(refused_file("refused/too-narrow.json", "W = 0.99 d"));
  scenes.push_back(refused_file("refused/own-images.json", "L_x = 2 d"));
  scenes.push_back(refused_file("refused/no-grains.json", "n = 0"));
  scenes.push_back(refused_file("refused/too-small.json", "sizes 1 to 50"));
  scenes.push_back(refused_file("refused/long-step.json", "a step of 2.5"));
  scenes.push_back(refused_file("refused/no-gravity.json", "g = 0"));
  scenes.push_back(refused_file("refused/tilted-gravity.json", "g tilted"));
  return scenes;
}

}  // namespace grainsweep::extremes
