// What the program asks the machine for: clocks, cores, memory, other programs.
#pragma once

#include <functional>
#include <string>

namespace grainsweep {

/// The value of an environment variable; null if it is not set.
using Environment = std::function<const char*(const char* name)>;

/// CPU time of the calling thread, s.
double thread_cpu_seconds();

/// Time since some fixed moment, s; never goes back.
double wall_seconds();

/// Time since 1970, s.
double calendar_seconds();

/// "2026-03-01T12:00:00Z"
std::string utc_now();

/// The command line of this process, as a shell takes it.
std::string command_line();

/// How this program was called, as a shell takes it: GRAINSWEEP_COMMAND, which run.sh sets, or the
/// first word of its command line. Commands that it prints begin with it.
std::string called_as();

/// The machine's name, with only the characters that are safe in a file name.
std::string host_name();

/// "<host>-<random number>-<pid>", the name this process writes under. Containers may share the
/// name of their host and have equal process numbers.
std::string process_name();

/// "<pid>" of such a name.
std::string number_of_process(const std::string& name);

/// Whether a process of this machine has ended; false for those of others, which cannot be asked.
bool has_ended(const std::string& process_name);

/// What the processor calls itself; empty if the system does not tell.
std::string processor_name();

/// Throws NoResources unless the system gives this process `count` more threads.
void expect_threads(int count);

/// Cores this process may use.
int usable_cores();

/// Memory that can be taken without swapping: what the kernel calls available, and not more than
/// limits leave (runner/memory_limits.hpp). Bytes; infinite if the system does not tell.
double available_memory();

/// The share of the memory that is available which live packings may take.
inline constexpr double share_for_packings = 0.8;

/// What live packings may take together, bytes; infinite if nothing limits them.
double memory_for_packings();

/// What a command printed, and its exit status.
struct Said {
  int code = 0;
  std::string text;  ///< without line feeds at its end
};

/// Runs a command of the shell. One that could not be started ends with 127, like one that the
/// shell does not find.
Said said_by(const std::string& command);

}  // namespace grainsweep
