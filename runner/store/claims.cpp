#include "runner/store/claims.hpp"

#include <fcntl.h>
#include <utility>

#include "runner/store/files.hpp"
#include "runner/store/shard.hpp"

namespace grainsweep {
namespace {

std::string claims_path(const std::string& folder) { return shards_folder(folder) + "/claims"; }

/// What a file holds from byte `from` on; nothing if it is gone, as when the sweep was made
/// meanwhile.
std::string rest_of(const std::string& path, std::int64_t from) {
  const std::int64_t size = file_size(path).value_or(0);
  if (size <= from) return "";
  try {
    return read_part(path, from, static_cast<std::size_t>(size - from));
  } catch (const FileError&) {
    if (!file_exists(path)) return "";
    throw;
  }
}

}  // namespace

Claims::Claims(const std::string& folder, std::string runner)
    : path_(claims_path(folder)), runner_(std::move(runner)) {}

Claims::Claims(const std::string& folder, std::string runner, const std::set<std::string>& at_work)
    : Claims(folder, std::move(runner)) {
  read(&at_work);
}

std::string Claims::owner_of(const std::string& job) const {
  const auto owner = owners_.find(job);
  return owner == owners_.end() ? "" : owner->second;
}

std::vector<std::string> Claims::take(const std::vector<std::string>& jobs) {
  if (jobs.empty()) return {};
  read();
  std::string lines;
  for (const std::string& job : jobs) {
    if (owner_of(job).empty()) lines.append(job).append(" ").append(runner_).append("\n");
  }
  if (!lines.empty()) {
    // What was torn before ends at the first line feed.
    write_all(OpenFile(path_, O_WRONLY | O_APPEND | O_CREAT), "\n" + lines);
    read();
  }
  std::vector<std::string> own;
  for (const std::string& job : jobs) {
    if (owner_of(job) == runner_) own.push_back(job);
  }
  return own;
}

bool Claims::may_begin(const std::string& job) {
  return !file_exists(path_) || !take({job}).empty();
}

void Claims::read(const std::set<std::string>* at_work) {
  const std::string text = rest_of(path_, read_to_);
  std::string_view rest = text;
  for (std::size_t end = rest.find('\n'); end != std::string_view::npos; end = rest.find('\n')) {
    read_line(rest.substr(0, end), at_work);
    rest.remove_prefix(end + 1);
  }
  read_to_ += static_cast<std::int64_t>(text.size() - rest.size());
}

void Claims::read_line(std::string_view line, const std::set<std::string>* at_work) {
  const std::size_t space = line.find(' ');
  if (space == std::string_view::npos) return;
  const std::string job(line.substr(0, space)), runner(line.substr(space + 1));
  const bool is_void = at_work != nullptr && runner != runner_ && !at_work->contains(runner);
  if (is_void) {
    if (!owners_.contains(job)) abandoned_.insert(job);
  } else if (owners_.try_emplace(job, runner).second) {
    abandoned_.erase(job);
  }
}

bool has_claims(const std::string& folder) {
  return file_size(claims_path(folder)).value_or(0) > 0;
}

void open_claims(const std::string& folder) {
  const OpenFile file(claims_path(folder), O_WRONLY | O_APPEND | O_CREAT);
}

void forget_claims(const std::string& folder) { remove_file(claims_path(folder)); }

}  // namespace grainsweep
