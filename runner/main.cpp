// grainsweep: what was asked for, doing it, and how it ended.
#include <exception>
#include <iostream>
#include <new>
#include <variant>

#include "runner/commands/command_line.hpp"
#include "runner/exit_codes.hpp"
#include "runner/jobs/stop.hpp"
#include "runner/store/files.hpp"
#include "runner/store/lock.hpp"
#include "runner/sweep/text_lines.hpp"

namespace grainsweep {
namespace {

int perform_and_print(const CommandLine& line) {
  const int code =
      line.command ? std::visit([](const auto& options) { return perform(options); }, *line.command)
                   : line.exit_code;
  if (!std::cout.flush()) throw FileError("standard output", "not everything could be written");
  return code;
}

int refuse(const std::exception& error, int code) {
  std::cerr << "grainsweep: " << lines_without_controls(error.what()) << "\n";
  return code;
}

}  // namespace
}  // namespace grainsweep

int main(int argc, char** argv) {
  using namespace grainsweep;
  try {
    ensure_std_descriptors();
    ignore_file_size_signal();
    return perform_and_print(read_command_line(argc, argv));
  } catch (const BadInput& error) {
    return refuse(error, exit_bad_input);
  } catch (const FolderBusy& error) {
    return refuse(error, exit_busy);
  } catch (const FileError& error) {
    return refuse(error, exit_file_system);
  } catch (const NoResources& error) {
    return refuse(error, exit_no_resources);
  } catch (const std::bad_alloc&) {
    return refuse(
        NoResources("out of memory; take fewer --threads or a smaller sweep, or raise the "
                    "limit of memory"),
        exit_no_resources);
  } catch (const std::exception& error) {
    return refuse(std::runtime_error(std::string("unforeseen error: ") + error.what()),
                  exit_unforeseen);
  }
}
