#include "runner/memory_limits.hpp"

#include <algorithm>
#include <fstream>
#include <limits>
#include <sstream>
#include <unistd.h>

#include <sys/resource.h>

namespace grainsweep {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// Names of the files of a group, which differ between the versions.
struct GroupFiles {
  const char* limit;
  const char* used;
  const char* cached;  ///< a line of memory.stat: files that can be dropped
};
constexpr GroupFiles version_1{"/memory.limit_in_bytes", "/memory.usage_in_bytes",
                               "total_inactive_file"};
constexpr GroupFiles version_2{"/memory.max", "/memory.current", "inactive_file"};

/// The number a file starts with; `otherwise` if it does not (a group without limit says "max").
double number_in(const std::string& path, double otherwise) {
  std::ifstream file(path);
  double number = 0.0;
  return file >> number ? number : otherwise;
}

double statistic_in(const std::string& path, const std::string& wanted) {
  std::ifstream file(path);
  std::string name;
  double number = 0.0;
  while (file >> name >> number) {
    if (name == wanted) return number;
  }
  return 0.0;
}

double left_in(const std::string& folder, const GroupFiles& files) {
  const double limit = number_in(folder + files.limit, infinite);
  const double used = number_in(folder + files.used, 0.0);
  return limit - std::max(0.0, used - statistic_in(folder + "/memory.stat", files.cached));
}

/// For a group and all above it. A container may see its own group in the place of the root: files
/// that are not there set no limit.
double least_left(const std::string& root, std::string group, const GroupFiles& files) {
  double left = infinite;
  while (!group.empty()) {
    left = std::min(left, left_in(root + group, files));
    group.resize(group.rfind('/'));
  }
  return std::min(left, left_in(root, files));
}

}  // namespace

double memory_left_in_groups(std::string_view groups, const std::string& root) {
  std::istringstream lines{std::string(groups)};
  double left = infinite;
  // "0::/a/b" is of version 2, "4:memory:/a/b" of version 1.
  for (std::string line; std::getline(lines, line);) {
    const std::size_t path = line.find('/'), controllers = line.find(':');
    if (path == std::string::npos || controllers == std::string::npos) continue;
    const std::string group = path + 1 == line.size() ? "" : line.substr(path);
    if (line.starts_with("0::")) left = std::min(left, least_left(root, group, version_2));
    const std::string names = "," + line.substr(controllers + 1, path - controllers - 2) + ",";
    if (names.find(",memory,") == std::string::npos) continue;
    left = std::min(left, least_left(root + "/memory", group, version_1));
  }
  return std::max(0.0, left);
}

double addresses_left() {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return infinite;
  const double pages = number_in("/proc/self/statm", 0.0);  // the first number: all addresses
  const double used = pages * static_cast<double>(sysconf(_SC_PAGESIZE));
  return std::max(0.0, static_cast<double>(limit.rlim_cur) - used);
}

}  // namespace grainsweep
