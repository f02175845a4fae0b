#include "runner/store/lock.hpp"

#include <cerrno>
#include <ctime>
#include <fcntl.h>

#include <sys/file.h>

namespace grainsweep {
namespace {

/// Takes the lock; returns 0 or the error that prevented it.
int take_lock(int descriptor) {
  constexpr int tries = 20;
  constexpr timespec pause{0, 10'000'000};
  for (int attempt = 1;; ++attempt) {
    if (flock(descriptor, LOCK_EX | LOCK_NB) == 0) return 0;
    const int error = errno;
    const bool may_pass = error == EWOULDBLOCK || error == EINTR;
    if (!may_pass || attempt == tries) return error;
    nanosleep(&pause, nullptr);
  }
}

}  // namespace

FileLock::FileLock(const std::string& path)
    : file_(path, O_RDWR | O_CREAT), error_(take_lock(file_.descriptor())) {}

bool FileLock::is_taken() const { return error_ == EWOULDBLOCK; }

bool is_locked(const std::string& path) {
  if (!file_exists(path)) return false;
  const OpenFile file(path, O_RDONLY);
  return flock(file.descriptor(), LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
}

}  // namespace grainsweep
