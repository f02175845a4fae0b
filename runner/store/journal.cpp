#include "runner/store/journal.hpp"

#include <algorithm>
#include <fcntl.h>

#include "runner/hash.hpp"
#include "runner/store/files.hpp"
#include "runner/store/lock.hpp"
#include "runner/store/outcome_text.hpp"

namespace grainsweep {
namespace {

std::string line_start(std::string_view outcome) {
  return R"({"length":)" + std::to_string(outcome.size()) + R"(,"crc32":")" + hex8(crc32(outcome)) +
         R"(","outcome":)";
}

/// The text of the outcome in a line; nothing if the line is torn or damaged.
std::optional<std::string_view> checked_text(std::string_view line) {
  constexpr std::string_view before_outcome = R"("outcome":)";
  const std::size_t start = line.find(before_outcome);
  if (start == std::string_view::npos || !line.ends_with('}')) return std::nullopt;
  const std::size_t begin = start + before_outcome.size();
  const std::string_view text = line.substr(begin, line.size() - begin - 1);
  return line.substr(0, begin) == line_start(text) ? std::optional(text) : std::nullopt;
}

/// A crash may have left a line without its end; the next one must not continue it.
bool ends_inside_a_line(const std::string& path) {
  if (!file_exists(path)) return false;
  const std::string text = read_file(path);
  return !text.empty() && text.back() != '\n';
}

}  // namespace

std::string journal_line(const Outcome& outcome) {
  const std::string text = outcome_text(outcome);
  return line_start(text) + text + "}\n";
}

std::optional<Outcome> read_journal_line(std::string_view line, Detail detail) {
  const auto text = checked_text(line);
  return text ? outcome_from_text(*text, detail) : std::nullopt;
}

Journal::Journal(const std::string& folder)
    : path_(folder + "/journal-" + process_name() + ".jsonl") {
  if (ends_inside_a_line(path_)) write_all(OpenFile(path_, O_WRONLY | O_APPEND), "\n");
}

void Journal::append(const Outcome& outcome) {
  const bool is_first = !file_exists(path_);
  const OpenFile file(path_, O_WRONLY | O_APPEND | O_CREAT);
  write_all(file, journal_line(outcome));
  flush_to_disk(file);
  if (is_first) flush_folder_of(path_);
}

JournalReading read_journals(const std::string& folder, Detail detail) {
  JournalReading reading;
  const auto keep = [&](Outcome&& outcome) {
    const auto [known, is_new] = reading.outcomes.try_emplace(outcome.job);
    if (is_new || !outcome.exception || known->second.exception) {
      known->second = std::move(outcome);
    }
  };
  for (const std::string& name : files_in(folder, "journal-", ".jsonl")) {
    const std::string path = folder + "/" + name;
    std::size_t number = 0;
    for_each_line(path, [&](std::string_view line) {
      ++number;
      if (auto outcome = read_journal_line(line, detail)) return keep(std::move(*outcome));
      reading.damage.push_back(path + ":" + std::to_string(number) +
                               ": torn or damaged line, or one of another version, left out; its "
                               "packing is made again");
    });
  }
  return reading;
}

}  // namespace grainsweep
