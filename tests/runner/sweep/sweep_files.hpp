// Sweep files on disk for tests of the reader.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <unistd.h>
#include <vector>

#include <catch2/catch.hpp>

#include "runner/sweep/read_sweep.hpp"

namespace grainsweep {

/// A folder of its own that vanishes with the object.
class ScratchFolder {
 public:
  ScratchFolder() {
    static int number = 0;
    path_ = std::filesystem::temp_directory_path() /
            ("grainsweep-" + std::to_string(getpid()) + "-" + std::to_string(++number));
    std::filesystem::create_directories(path_);
  }
  ~ScratchFolder() { std::filesystem::remove_all(path_); }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  /// Writes `text` to the file `name` and returns its path.
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
    return (path_ / name).string();
  }
  std::string path(const std::string& name) const { return (path_ / name).string(); }

  /// `text` without the folder's own path.
  std::string without_folder(std::string text) const {
    const std::string prefix = path_.string() + "/";
    for (std::size_t at = text.find(prefix); at != std::string::npos; at = text.find(prefix)) {
      text.erase(at, prefix.size());
    }
    return text;
  }

 private:
  std::filesystem::path path_;
};

/// The reading of a file s.json that holds `text`.
inline SweepReading reading_of(const std::string& text) {
  const ScratchFolder folder;
  return read_sweep(folder.write("s.json", text));
}

/// What `check` notes about a sweep, which has jobs and no errors.
template <class Check>
std::vector<Diagnostic> notes_of(const std::string& text, const Check& check) {
  const ScratchFolder folder;
  const SweepReading reading = read_sweep(folder.write("s.json", text), check);
  CHECK(reading.errors.empty());
  CHECK_FALSE(reading.sweep.jobs.empty());
  return reading.notes;
}

/// The messages about `text` as a user sees them, with "s.json" as the file.
inline std::vector<std::string> errors_of(const std::string& text) {
  const ScratchFolder folder;
  std::vector<std::string> errors;
  for (const Diagnostic& diagnostic : read_sweep(folder.write("s.json", text)).errors) {
    errors.push_back(folder.without_folder(to_string(diagnostic)));
  }
  return errors;
}

/// The jobs of a file; none if it has an error.
inline std::vector<Job> jobs_of(const std::string& text) { return reading_of(text).sweep.jobs; }

/// A sweep with these blocks, e.g. R"({"grid": {"box.width": [4, 5]}})", and these parameters.
inline std::string sweep_of(const std::string& blocks, const std::string& base = "{}") {
  return R"({"name": "t", "base": )" + base + R"(, "sweep": [)" + blocks + "]}";
}

}  // namespace grainsweep
