#include "runner/store/lock.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <ctime>
#include <fcntl.h>
#include <unistd.h>

#include <sys/file.h>

namespace grainsweep {
namespace {

constexpr const char* lock_name = "/runner.lock";

/// Takes the lock, or sets errno. Tries for a fifth of a second, since a look at the lock
/// (present_runner) holds it for a moment.
bool take_lock(int descriptor) {
  constexpr int tries = 20;
  constexpr timespec pause{0, 10'000'000};
  for (int attempt = 1; flock(descriptor, LOCK_EX | LOCK_NB) != 0; ++attempt) {
    const int error = errno;
    const bool may_pass = error == EWOULDBLOCK || error == EINTR;
    if (may_pass && attempt < tries) nanosleep(&pause, nullptr);
    errno = error;
    if (!may_pass || attempt == tries) return false;
  }
  return true;
}

std::string owner_in(const std::string& path) {
  std::string owner = read_file(path);
  owner.erase(std::find(owner.begin(), owner.end(), '\n'), owner.end());
  return owner.empty() ? "another process" : owner;
}

}  // namespace

std::string host_name() {
  std::array<char, 256> name{};
  if (gethostname(name.data(), name.size() - 1) != 0 || name[0] == '\0') return "unknown";
  std::string text = name.data();
  const auto unsafe = [](unsigned char c) { return std::isalnum(c) == 0 && c != '.' && c != '-'; };
  std::replace_if(text.begin(), text.end(), unsafe, '_');
  return text;
}

FolderLock::FolderLock(const std::string& folder)
    : file_(folder + lock_name, O_RDWR | O_CREAT), is_held_(take_lock(file_.descriptor())) {
  if (!is_held_ && errno == EWOULDBLOCK) {
    throw FolderBusy(folder + ": another runner works here (" + owner_in(file_.path()) +
                     "); wait for it or give another folder with --out");
  }
  if (!is_held_) return;
  // Written over the last owner's line and cut after it, so that the file is never empty meanwhile.
  const std::string owner = "host " + host_name() + ", process " + std::to_string(getpid()) + "\n";
  write_all(file_, owner);
  const auto size = static_cast<off_t>(owner.size());
  if (ftruncate(file_.descriptor(), size) != 0) throw FileError(file_.path(), "write", errno);
}

std::optional<std::string> present_runner(const std::string& folder) {
  const std::string path = folder + lock_name;
  if (!file_exists(path)) return std::nullopt;
  const OpenFile file(path, O_RDONLY);
  const bool is_free = flock(file.descriptor(), LOCK_SH | LOCK_NB) == 0 || errno != EWOULDBLOCK;
  return is_free ? std::nullopt : std::optional(owner_in(path));
}

std::string process_name() { return host_name() + "-" + std::to_string(getpid()); }

}  // namespace grainsweep
