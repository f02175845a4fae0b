#include "runner/machine.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cctype>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <fstream>
#include <iterator>
#include <limits>
#include <random>
#include <sstream>
#include <string>
#include <thread>
#include <unistd.h>
#include <vector>

#include <sys/wait.h>
#include <tbb/info.h>

#include "runner/exit_codes.hpp"
#include "runner/memory_limits.hpp"
#include "runner/text.hpp"

namespace grainsweep {
namespace {

double seconds_of(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// Infinite where the system does not tell.
double memory_left_on_the_machine() {
  std::ifstream file("/proc/meminfo");
  std::string name, rest;
  double kilobytes = 0.0;
  while (file >> name >> kilobytes && std::getline(file, rest)) {
    if (name == "MemAvailable:") return 1024.0 * kilobytes;
  }
  return std::numeric_limits<double>::infinity();
}

double memory_left_in_the_control_groups() {
  std::ifstream file("/proc/self/cgroup");
  std::ostringstream groups;
  groups << file.rdbuf();
  return memory_left_in_groups(groups.str(), "/sys/fs/cgroup");
}

}  // namespace

double thread_cpu_seconds() { return seconds_of(CLOCK_THREAD_CPUTIME_ID); }

double wall_seconds() { return seconds_of(CLOCK_MONOTONIC); }

double calendar_seconds() { return seconds_of(CLOCK_REALTIME); }

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text.data();
}

std::string command_line() {
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  std::string word, words;
  while (std::getline(file, word, '\0')) words += (words.empty() ? "" : " ") + shell_word(word);
  return words;
}

std::string called_as() {
  const char* const given = std::getenv("GRAINSWEEP_COMMAND");
  if (given != nullptr && *given != '\0') return given;
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  std::string word;
  return std::getline(file, word, '\0') && !word.empty() ? shell_word(word) : "grainsweep";
}

std::string host_name() {
  std::array<char, 256> name{};
  if (gethostname(name.data(), name.size() - 1) != 0 || name[0] == '\0') return "unknown";
  std::string text = name.data();
  const auto unsafe = [](unsigned char c) { return std::isalnum(c) == 0 && c != '.' && c != '-'; };
  std::replace_if(text.begin(), text.end(), unsafe, '_');
  return text;
}

std::string process_name() {
  static const std::string token = std::to_string(std::random_device{}());
  return host_name() + "-" + token + "-" + std::to_string(getpid());
}

std::string number_of_process(const std::string& name) { return name.substr(name.rfind('-') + 1); }

namespace {

/// Of "HOST-TOKEN-NUMBER"; names of hosts may hold dashes themselves. Empty if it is no such name.
std::string host_of_process(const std::string& name) {
  const std::size_t before_number = name.rfind('-');
  if (before_number == std::string::npos || before_number == 0) return "";
  const std::size_t before_token = name.rfind('-', before_number - 1);
  return before_token == std::string::npos ? "" : name.substr(0, before_token);
}

}  // namespace

bool has_ended(const std::string& process_name) {
  if (host_of_process(process_name) != host_name()) return false;
  const std::string number = number_of_process(process_name);
  constexpr std::size_t most_digits = 9;
  if (number.size() > most_digits) return false;
  if (kill(std::stoi(number), 0) != 0 && errno == ESRCH) return true;
  // One that was killed has its number until its parent has looked: "4711 (its name) Z ...".
  std::ifstream file("/proc/" + number + "/stat");
  const std::string stat{std::istreambuf_iterator<char>(file), {}};
  const std::size_t name_end = stat.rfind(") ");
  return name_end != std::string::npos && (stat[name_end + 2] == 'Z' || stat[name_end + 2] == 'X');
}

std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  std::string line;
  while (std::getline(file, line)) {
    const std::size_t colon = line.find(": ");
    const bool is_named = line.starts_with("model name") && colon != std::string::npos;
    if (is_named) return line.substr(colon + 2);
  }
  return "";
}

void expect_threads(int count) {
  std::vector<std::thread> threads;
  std::atomic<bool> may_end{false};
  bool is_given = true;
  try {
    for (int i = 0; i < count; ++i) threads.emplace_back([&] { may_end.wait(false); });
  } catch (const std::exception&) {  // also where there is no memory for one
    is_given = false;
  }
  may_end = true;
  may_end.notify_all();
  for (std::thread& thread : threads) thread.join();
  if (is_given) return;
  throw NoResources(threads.empty()
                        ? "the system gives not even one thread: raise the limits of processes "
                          "(ulimit -u) and of memory (ulimit -v)"
                        : "the system gives no more than " + std::to_string(threads.size()) +
                              " of " + std::to_string(count) + " threads; take fewer --threads");
}

int usable_cores() { return std::max(1, tbb::info::default_concurrency()); }

double available_memory() {
  return std::min(
      {memory_left_on_the_machine(), memory_left_in_the_control_groups(), addresses_left()});
}

double memory_for_packings() { return share_for_packings * available_memory(); }

Said said_by(const std::string& command) {
  std::FILE* const pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return {127, "no process could be started"};
  Said said;
  std::array<char, 4096> part{};
  for (std::size_t size = 1; size > 0;) {
    size = std::fread(part.data(), 1, part.size(), pipe);
    said.text.append(part.data(), size);
  }
  const int status = pclose(pipe);
  said.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  while (said.text.ends_with('\n')) said.text.pop_back();
  return said;
}

}  // namespace grainsweep
