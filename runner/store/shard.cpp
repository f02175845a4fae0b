#include "runner/store/shard.hpp"

#include <charconv>

#include "runner/store/files.hpp"

namespace grainsweep {
namespace {

constexpr std::string_view journal_ending = ".jsonl", beds_ending = ".beds";

/// Takes a positive number off the front of `text`; if there is none, returns nothing and leaves
/// `text` as it was.
std::optional<int> take_number(std::string_view& text) {
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || number < 1) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return number;
}

/// The shard whose number and count stand around `between` at the front of `text`; takes them off.
std::optional<Shard> take_shard(std::string_view& text, std::string_view between) {
  const auto number = take_number(text);
  if (!number || !text.starts_with(between)) return std::nullopt;
  text.remove_prefix(between.size());
  const auto count = take_number(text);
  if (!count || *number > *count) return std::nullopt;
  return Shard{*number, *count};
}

}  // namespace

std::string name_of(const Shard& shard) {
  return std::to_string(shard.number) + "-of-" + std::to_string(shard.count);
}

std::optional<Shard> shard_from_name(std::string_view name) { return take_shard(name, "-of-"); }

std::optional<Shard> shard_from_text(std::string_view text) {
  const auto shard = take_shard(text, "/");
  return text.empty() ? shard : std::nullopt;
}

std::string shards_folder(const std::string& folder) { return folder + "/shards"; }

std::string tables_lock(const std::string& folder) {
  return shards_folder(folder) + "/tables.lock";
}

std::string journal_path(const std::string& folder, const std::string& name) {
  return shards_folder(folder) + "/" + name + std::string(journal_ending);
}

std::string beds_path(const std::string& folder, const std::string& name) {
  return shards_folder(folder) + "/" + name + std::string(beds_ending);
}

std::vector<std::string> beds_without_journal(const std::string& folder) {
  std::vector<std::string> paths;
  for (const std::string& file : files_in(shards_folder(folder), "", beds_ending)) {
    const std::string name = file.substr(0, file.size() - beds_ending.size());
    if (shard_from_name(name) && !file_exists(journal_path(folder, name))) {
      paths.push_back(beds_path(folder, name));
    }
  }
  return paths;
}

std::vector<std::string> shards_in(const std::string& folder) {
  std::vector<std::string> names;
  for (std::string& name : files_in(shards_folder(folder), "", journal_ending)) {
    name.resize(name.size() - journal_ending.size());
    if (shard_from_name(name)) names.push_back(std::move(name));
  }
  return names;
}

}  // namespace grainsweep
