#include "runner/store/files.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <fcntl.h>
#include <filesystem>
#include <limits>
#include <string>
#include <system_error>
#include <unistd.h>
#include <utility>

#include <sys/stat.h>

#include "runner/machine.hpp"

namespace grainsweep {
namespace {

/// Between the name of a file and the process that writes its successor beside it.
constexpr std::string_view temporary_mark = ".tmp.";

/// Repeats a system call while a signal interrupts it.
template <class Call>
auto uninterrupted(Call call) {
  auto result = call();
  while (result == -1 && errno == EINTR) result = call();
  return result;
}

std::string folder_of(const std::string& path) {
  const std::string folder = std::filesystem::path(path).parent_path().string();
  return folder.empty() ? "." : folder;
}

/// Appends the next bytes of the file, at most `most`; false at its end.
bool read_more(const OpenFile& file, std::string& text,
               std::size_t most = std::numeric_limits<std::size_t>::max()) {
  std::array<char, 1 << 16> block{};
  const std::size_t size = std::min(most, block.size());
  const ssize_t count = uninterrupted([&] { return read(file.descriptor(), block.data(), size); });
  if (count < 0) throw FileError(file.path(), "read", errno);
  text.append(block.data(), static_cast<std::size_t>(count));
  return count > 0;
}

/// Throws unless the folder `path`, which was to be made with this result, exists.
void expect_folder(const std::string& path, const std::error_code& error) {
  if (error) throw FileError(path, "make the folder", error.value());
  if (!std::filesystem::is_directory(path)) throw FileError(path, "make the folder", ENOTDIR);
}

}  // namespace

FileError::FileError(const std::string& path, const std::string& action, int error)
    : std::runtime_error(path + ": cannot " + action + ": " +
                         std::generic_category().message(error)) {}

FileError::FileError(const std::string& path, const std::string& what)
    : std::runtime_error(path + ": " + what) {}

namespace {

/// To open a pipe would wait for somebody at its other end.
int opened_as(int flags) { return flags | O_CLOEXEC | O_NONBLOCK; }

/// Whether there is no end to what can be read from it, or nothing written to it is kept.
bool is_endless(int descriptor, bool is_read) {
  struct stat known {};
  return fstat(descriptor, &known) == 0 && (S_ISFIFO(known.st_mode) || S_ISSOCK(known.st_mode) ||
                                            (is_read && S_ISCHR(known.st_mode)));
}

}  // namespace

OpenFile::OpenFile(std::string path, int flags, unsigned mode)
    : path_(std::move(path)),
      descriptor_(uninterrupted([&] { return open(path_.c_str(), opened_as(flags), mode); })) {
  const bool is_pipe_without_reader = descriptor_ < 0 && errno == ENXIO;
  if (descriptor_ < 0 && !is_pipe_without_reader) throw FileError(path_, "open", errno);
  const bool is_read = (flags & O_ACCMODE) == O_RDONLY;
  if (!is_pipe_without_reader && !is_endless(descriptor_, is_read)) return;
  if (descriptor_ >= 0) close(std::exchange(descriptor_, -1));
  throw FileError(path_, "is a pipe or a device, not a file");
}

OpenFile::~OpenFile() {
  if (descriptor_ >= 0) close(descriptor_);
}

void ensure_std_descriptors() {
  int descriptor = 0;
  while (descriptor >= 0 && descriptor <= STDERR_FILENO) descriptor = open("/dev/null", O_RDONLY);
  if (descriptor > STDERR_FILENO) close(descriptor);
}

void write_all(const OpenFile& file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written =
        uninterrupted([&] { return write(file.descriptor(), bytes.data(), bytes.size()); });
    if (written < 0) throw FileError(file.path(), "write", errno);
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

void flush_to_disk(const OpenFile& file) {
  if (uninterrupted([&] { return fsync(file.descriptor()); }) == 0) return;
  const bool cannot_be_flushed = errno == EINVAL || errno == ENOTSUP;  // not a plain file
  if (!cannot_be_flushed) throw FileError(file.path(), "flush to disk", errno);
}

void flush_folder_of(const std::string& path) {
  flush_to_disk(OpenFile(folder_of(path), O_RDONLY | O_DIRECTORY));
}

std::string read_file(const std::string& path) {
  const OpenFile file(path, O_RDONLY);
  std::string text;
  while (read_more(file, text)) {
  }
  return text;
}

std::string read_part(const std::string& path, std::int64_t at, std::size_t size) {
  const OpenFile file(path, O_RDONLY);
  if (lseek(file.descriptor(), at, SEEK_SET) < 0) throw FileError(path, "read", errno);
  std::string text;
  while (text.size() < size && read_more(file, text, size - text.size())) {
  }
  return text;
}

void for_each_line(const std::string& path, const std::function<void(std::string_view)>& use) {
  const OpenFile file(path, O_RDONLY);
  std::string text;
  while (read_more(file, text)) {
    std::string_view rest = text;
    for (std::size_t end = rest.find('\n'); end != std::string_view::npos; end = rest.find('\n')) {
      use(rest.substr(0, end));
      rest.remove_prefix(end + 1);
    }
    text.erase(0, text.size() - rest.size());
  }
  if (!text.empty()) use(text);
}

namespace {

/// The process that writes a temporary file of this name for a file whose name ends in `ending`;
/// empty if it is none.
std::string writer_of(const std::string& name, std::string_view ending) {
  const std::string mark = std::string(ending) + std::string(temporary_mark);
  const std::size_t at = name.rfind(mark);
  if (at == std::string::npos) return "";
  const std::string process = name.substr(at + mark.size());
  const std::string number = number_of_process(process);
  return number.find_first_not_of("0123456789") == std::string::npos && !number.empty() ? process
                                                                                        : "";
}

/// Whether nothing was written to it for so long that nobody is writing it: a container of the same
/// host name may have processes that cannot be seen.
bool is_abandoned(const std::string& path) {
  constexpr std::chrono::minutes longest_pause(10);
  std::error_code error;
  const auto written = std::filesystem::last_write_time(path, error);
  return !error && std::filesystem::file_time_type::clock::now() - written > longest_pause;
}

}  // namespace

void remove_leftovers(const std::string& folder, std::string_view ending) {
  for (const std::string& name : files_in(folder, "", "")) {
    if (!writer_of(name, ending).empty()) remove_file(folder + "/" + name);
  }
}

void remove_leftovers_of_ended(const std::string& folder) {
  for (const std::string& name : files_in(folder, "", "")) {
    const std::string process = writer_of(name, ""), path = folder + "/" + name;
    if (!process.empty() && has_ended(process) && is_abandoned(path)) remove_file(path);
  }
}

void replace_file(const std::string& path, std::string_view bytes, Flush flush) {
  Replacement file(path);
  file.write(bytes);
  file.commit(flush);
}

Replacement::Replacement(std::string path)
    : path_(std::move(path)),
      temporary_(path_ + std::string(temporary_mark) + process_name()),
      file_(temporary_, O_WRONLY | O_CREAT | O_TRUNC) {}

Replacement::~Replacement() {
  if (!is_committed_) unlink(temporary_.c_str());
}

void Replacement::write(std::string_view bytes) {
  constexpr std::size_t most_kept = 1 << 20;
  if (bytes_.size() + bytes.size() < most_kept) {
    bytes_ += bytes;
    return;
  }
  write_all(file_, bytes_);
  write_all(file_, bytes);
  bytes_.clear();
}

void Replacement::commit(Flush flush) {
  write_all(file_, bytes_);
  if (flush == Flush::now) flush_to_disk(file_);
  if (std::rename(temporary_.c_str(), path_.c_str()) != 0) throw FileError(path_, "replace", errno);
  is_committed_ = true;
  if (flush == Flush::now) flush_folder_of(path_);
}

void make_folder(const std::string& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  expect_folder(path, error);
}

void make_folder_inside(const std::string& path) {
  std::error_code error;
  const bool is_new = std::filesystem::create_directory(path, error);
  expect_folder(path, error);
  if (is_new) flush_folder_of(path);
}

void remove_file(const std::string& path) {
  if (unlink(path.c_str()) != 0 && errno != ENOENT) throw FileError(path, "remove", errno);
}

std::optional<std::int64_t> file_size(const std::string& path) {
  struct stat status {};
  if (stat(path.c_str(), &status) == 0) return status.st_size;
  if (errno == ENOENT || errno == ENOTDIR) return std::nullopt;
  throw FileError(path, "look up", errno);
}

bool file_exists(const std::string& path) { return file_size(path).has_value(); }

std::vector<std::string> files_in(const std::string& folder, std::string_view start,
                                  std::string_view end) {
  std::vector<std::string> names;
  std::error_code error;
  std::filesystem::directory_iterator entry(folder, error);
  for (const std::filesystem::directory_iterator last; !error && entry != last;
       entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (name.starts_with(start) && name.ends_with(end)) names.push_back(name);
  }
  if (error && error != std::errc::no_such_file_or_directory) {
    throw FileError(folder, "list", error.value());
  }
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace grainsweep
