// The command `doctor`: what this machine offers, and whether results can be written here.
#include <iostream>

#include <CLI/App.hpp>

#include "runner/commands/commands.hpp"
#include "runner/exit_codes.hpp"
#include "runner/instruction_set.hpp"
#include "runner/machine.hpp"
#include "runner/report/gnuplot.hpp"
#include "runner/store/files.hpp"
#include "runner/text.hpp"
#include "runner/versions.hpp"

namespace grainsweep {
namespace {

/// Writes, flushes and removes a small file here; returns how long that took, s.
double write_test() {
  const std::string path = "grainsweep-write-test." + process_name();
  const double start = wall_seconds();
  replace_file(path, "written by grainsweep doctor\n");
  remove_file(path);
  return wall_seconds() - start;
}

/// The program that draws the figures of pages, or what is missing without it.
std::string drawing_text() {
  const std::string version = gnuplot_version();
  return version.empty() ? "no gnuplot: pages have no figures (Debian: apt-get install gnuplot-nox)"
                         : version;
}

std::string versions_text() {
  std::string text;
  for (const auto& [name, version] : library_versions()) {
    text += (text.empty() ? "" : ", ") + name + " " + version;
  }
  return text;
}

}  // namespace

void add_command(CLI::App& app, DoctorOptions& /*options*/) {
  CLI::App& doctor = *app.add_subcommand(
      "doctor", "Say what this machine offers and whether results can be written");
  doctor.footer("Example: grainsweep doctor");
}

int perform(const DoctorOptions& /*options*/) {
  std::cout << "grainsweep " << program_version() << ", built with " << compiler_version()
            << "\nlibraries         " << versions_text() << "\ninstruction sets  "
            << supported_isas() << "; used: " << name_of(choose_isa("")) << "\ncores             "
            << usable_cores() << "\nmemory            " << fixed(available_memory() / 1e9, 1)
            << " GB available\nfigures           " << drawing_text() << "\n"
            << std::flush;
  std::cout << "writing here      " << std::flush;
  try {
    const double seconds = write_test();
    std::cout << "works, " << fixed(1e3 * seconds, 1) << " ms for a file kept on the disk\n";
  } catch (const FileError& error) {
    std::cout << "fails: " << error.what() << "\n";
    return exit_file_system;
  }
  return exit_done;
}

}  // namespace grainsweep
