#include "runner/store/journal.hpp"

#include <array>
#include <charconv>
#include <cinttypes>
#include <cstdio>
#include <fcntl.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "runner/store/checksum.hpp"
#include "runner/store/files.hpp"
#include "runner/store/journal_lines.hpp"
#include "runner/store/lock.hpp"

namespace grainsweep {
namespace {

std::string line_start(std::string_view outcome) {
  std::array<char, 80> text{};
  std::snprintf(text.data(), text.size(), R"({"length":%zu,"crc32":"%08)" PRIx32 R"(","outcome":)",
                outcome.size(), crc32(outcome));
  return text.data();
}

/// A crash may have left a line without its end; the next one must not continue it.
bool ends_inside_a_line(const std::string& path) {
  if (!file_exists(path)) return false;
  const std::string text = read_file(path);
  return !text.empty() && text.back() != '\n';
}

}  // namespace

std::string journal_line(const Outcome& outcome) {
  const std::string text =
      to_json(outcome).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  return line_start(text) + text + "}\n";
}

std::optional<std::string_view> outcome_in(std::string_view line) {
  constexpr std::string_view before_outcome = R"("outcome":)";
  const std::size_t start = line.find(before_outcome);
  if (start == std::string_view::npos || !line.ends_with('}')) return std::nullopt;
  const std::size_t begin = start + before_outcome.size();
  const std::string_view text = line.substr(begin, line.size() - begin - 1);
  return line.substr(0, begin) == line_start(text) ? std::optional(text) : std::nullopt;
}

std::optional<Outcome> read_journal_line(std::string_view line) {
  const auto text = outcome_in(line);
  if (!text) return std::nullopt;
  try {
    return outcome_from_json(nlohmann::json::parse(*text));
  } catch (const std::exception&) {
    return std::nullopt;  // whole, but written by a version with other members
  }
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

JournalReading read_journals(const std::string& folder) {
  JournalReading reading;
  reading.damage = collect_lines(folder, read_journal_line, reading.outcomes);
  return reading;
}

}  // namespace grainsweep
