#include <fstream>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "tests/runner/sweep/sweep_files.hpp"

namespace grainsweep {
namespace {

/// What stands below a title of faulty_sweeps.txt, whose head says how it is written.
struct FaultySweep {
  std::string title, text;
  std::vector<std::string> said = {};
};

std::vector<FaultySweep> faulty_sweeps() {
  std::ifstream file(GRAINSWEEP_TESTS "/runner/sweep/faulty_sweeps.txt");
  std::vector<FaultySweep> all;
  bool is_text = true;
  for (std::string line; std::getline(file, line);) {
    const bool is_title = line.starts_with("== ");
    if (is_title) {
      all.push_back({line.substr(3), ""});
    } else if (all.empty() || line == "--" || line.starts_with("~~")) {
      is_text = false;
      continue;
    } else if (is_text) {
      all.back().text += line + "\n";
    } else if (!line.empty()) {
      all.back().said.push_back(line);
    }
    is_text = is_text || is_title;
  }
  return all;
}

/// What `validate` says of the file.
std::vector<std::string> said_of(const ScratchFolder& folder, const std::string& path) {
  const SweepReading reading = read_sweep(path);
  std::vector<std::string> said;
  for (const Diagnostic& error : reading.errors) {
    said.push_back(folder.without_folder(to_string(error)));
  }
  if (said.empty()) said.push_back("right");
  for (const Diagnostic& note : reading.notes) {
    said.push_back("note: " + folder.without_folder(to_string(note)));
  }
  return said;
}

}  // namespace

TEST_CASE("faulty sweeps are refused at the right place, with what to change") {
  const ScratchFolder folder;
  int sweeps = 0;
  for (const FaultySweep& sweep : faulty_sweeps()) {
    if (sweep.title.starts_with("file ")) {
      folder.write(sweep.title.substr(5), sweep.text);
      continue;
    }
    INFO(sweep.title << "\n" << sweep.text);
    const std::string text = sweep.text.substr(0, sweep.text.size() - 1);
    CHECK(said_of(folder, folder.write("s.json", text)) == sweep.said);
    ++sweeps;
  }
  CHECK(sweeps >= 100);
}

}  // namespace grainsweep
