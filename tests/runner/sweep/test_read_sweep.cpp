#include <random>
#include <set>

#include <catch2/catch.hpp>

#include "tests/runner/sweep/sweep_files.hpp"

namespace grainsweep {
namespace {

const std::string whole_file = R"({ "name": "whole", "seed": 20130708, "replicates": 3,
  "base":  { "shape": "sphere",
             "box":   { "length": 20, "width": 10, "x": "periodic", "y": "walls" },
             "fill":  { "solid_height": 9.95 },
             "sizes": { "spread": 0.033333, "small_share": 0, "size_ratio": 0.5 },
             "accuracy": { "preset": "balanced", "solver": "pgs", "precision": "f64" },
             "measure": { "exclude_floor": 2.5, "gap_tolerances": [1e-4, 1e-5] } },
  "sweep": [ { "label": "MSP", "grid": { "box.width": [5, 6, 8, 10, 15, 20] } },
             { "label": "MSP bulk", "set": { "box.width": 20, "box.y": "periodic" } },
             { "label": "BSP", "grid": { "box.width": [5, 10, 20], "sizes.small_share": [0.1, 0.25, 0.4] } },
             { "label": "pairs", "zip": { "box.width": [5, 10], "seed": [1, 2] }, "replicates": 1 },
             { "label": "spread", "random": { "count": 4, "box.width": { "log_uniform": [5, 20] },
                                              "accuracy": { "choice": ["fast", "accurate"] } } } ] }
)";

/// Errors must have a place, a message and, being read at all, no jobs beside them.
bool is_sound(const SweepReading& reading) {
  for (const Diagnostic& diagnostic : reading.errors) {
    if (diagnostic.place.empty() || diagnostic.message.empty()) return false;
  }
  return reading.errors.empty() != reading.sweep.jobs.empty();
}

}  // namespace

TEST_CASE("a file with every kind of block is read whole") {
  const SweepReading reading = reading_of(whole_file);
  REQUIRE(reading.errors.empty());
  const Sweep& sweep = reading.sweep;
  CHECK(sweep.name == "whole");
  CHECK(sweep.seed == 20130708);
  CHECK(sweep.replicates == 3);
  CHECK(sweep.jobs.size() == 18 + 3 + 27 + 2 + 12);
  std::set<std::string> ids;
  for (const Job& job : sweep.jobs) ids.insert(job.id);
  CHECK(ids.size() == sweep.jobs.size());
  CHECK(sweep.jobs[0].spec.accuracy.solver == Solver::projected_gauss_seidel);
  CHECK(sweep.jobs[0].spec.measure.exclude_floor == 2.5);
  CHECK(sweep.jobs[18].spec.box.y == Boundary::periodic);
  CHECK(sweep.jobs[48].seed == 1);
}

TEST_CASE("all errors of a file are reported at once, in its order") {
  const auto errors = errors_of(R"({
  "sweep": [{"grid": {"box.width": [0.5, "x"]}}],
  "name": "a b",
  "bse": 1,
  "base": {"sizes": {"spread": 0.5}, "box": {"z": 1}},
  "seed": -1
})");
  REQUIRE(errors.size() == 7);
  CHECK(errors[0].starts_with("s.json:2:37 /sweep/0/grid/box.width/0: "));
  CHECK(errors[1].starts_with("s.json:2:42 /sweep/0/grid/box.width/1: "));
  CHECK(errors[2].starts_with("s.json:3:11 /name: "));
  CHECK(errors[3].starts_with("s.json:4:3 /bse: "));
  CHECK(errors[4].starts_with("s.json:5:32 /base/sizes/spread: "));
  CHECK(errors[5].starts_with("s.json:5:46 /base/box/z: "));
  CHECK(errors[6].starts_with("s.json:6:11 /seed: "));
}

TEST_CASE("control characters in a key do not reach the terminal") {
  CHECK(errors_of(R"({"name": "t", "\u001b[2J": 1})") ==
        std::vector<std::string>{"s.json:1:15 /?[2J: unknown key \"?[2J\"; known here: name, seed, "
                                 "replicates, units, base, sweep, $schema"});
}

TEST_CASE("a file is read no further than one may be long", "[slow]") {  // a second for 256 MiB
  const ScratchFolder folder;
  const std::string path = folder.write("s.json", " ");
  std::filesystem::resize_file(path,
                               (std::uintmax_t{256} << 20U) + 1);  // takes no room on the disk
  const SweepReading reading = read_sweep(path);
  REQUIRE(reading.errors.size() == 1);
  CHECK(folder.without_folder(to_string(reading.errors[0])) == "s.json: is larger than 256 MiB");
}

TEST_CASE("a device is refused at once") {
  const SweepReading reading = read_sweep("/dev/zero");
  REQUIRE(reading.errors.size() == 1);
  CHECK(to_string(reading.errors[0]) == "/dev/zero: is a pipe or a device, not a file");
}

TEST_CASE("files that cannot be read are refused by name") {
  const ScratchFolder folder;
  const auto errors = read_sweep(folder.path("none.json")).errors;
  REQUIRE(errors.size() == 1);
  CHECK(folder.without_folder(to_string(errors[0])) ==
        "none.json: cannot be read: No such file or directory");
}

TEST_CASE("the sweeps that come with the program can be read") {
  for (const char* name :
       {"quick.json", "confined-spheres.json", "paper-spheres.json", "pinacoids-quick.json",
        "paper-pinacoids.json", "pinacoid-protocol.json"}) {
    const SweepReading reading = read_sweep(std::string(GRAINSWEEP_CONFIGS) + "/" + name);
    INFO(name);
    for (const Diagnostic& diagnostic : reading.errors) FAIL(to_string(diagnostic));
    CHECK(reading.sweep.name + ".json" == name);
    CHECK_FALSE(reading.sweep.jobs.empty());
  }
}

TEST_CASE("a file cut off anywhere is refused without harm") {
  for (std::size_t size = 0; size + 2 < whole_file.size(); ++size) {
    const SweepReading reading = reading_of(whole_file.substr(0, size));
    INFO(size);
    REQUIRE(reading.errors.size() == 1);
    REQUIRE(is_sound(reading));
  }
}

TEST_CASE("a file with changed bytes is read or refused without harm") {
  std::mt19937 random(1);  // its sequence is fixed by the standard
  const std::string bytes = "{}[]\",:\\0123456789.eE+-xyz\n\t\xC3\xFF";
  int refused = 0;
  for (int round = 0; round < 500; ++round) {
    std::string text = whole_file;
    const auto changes = 1 + random() % 4;
    for (unsigned change = 0; change < changes; ++change) {
      text[random() % text.size()] = bytes[random() % bytes.size()];
    }
    const SweepReading reading = reading_of(text);
    INFO(text);
    REQUIRE(is_sound(reading));
    refused += reading.errors.empty() ? 0 : 1;
  }
  CHECK(refused > 166);
  CHECK(refused < 500);
}

TEST_CASE("a file with pieces moved about is read or refused without harm") {
  std::mt19937 random(2);
  for (int round = 0; round < 200; ++round) {
    std::string text = whole_file;
    const std::size_t from = random() % text.size(), to = random() % text.size();
    const std::string piece = text.substr(from, random() % 60);
    if (round % 2 == 0) text.erase(from, piece.size());
    text.insert(std::min(to, text.size()), piece);
    const SweepReading reading = reading_of(text);
    INFO(text);
    REQUIRE(is_sound(reading));
  }
}

}  // namespace grainsweep
