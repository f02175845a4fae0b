#include "runner/store/journal.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include <nlohmann/json.hpp>

#include "runner/hash.hpp"
#include "runner/store/files.hpp"
#include "runner/store/lock.hpp"
#include "runner/store/outcome_text.hpp"
#include "runner/store/shard.hpp"

namespace grainsweep {
namespace {

constexpr std::string_view outcome_kind = "outcome", run_kind = "run";

std::string line_start(std::string_view kind, std::string_view text) {
  return R"({"length":)" + std::to_string(text.size()) + R"(,"crc32":")" + hex8(crc32(text)) +
         R"(",")" + std::string(kind) + R"(":)";
}

std::string line_of(std::string_view kind, std::string_view text) {
  return line_start(kind, text).append(text).append("}\n");
}

/// The text of that kind in a line; nothing if the line is torn, damaged or of another kind.
std::optional<std::string_view> checked_text(std::string_view kind, std::string_view line) {
  const std::string before_text = std::string(",\"").append(kind).append("\":");
  const std::size_t start = line.find(before_text);
  if (start == std::string_view::npos || !line.ends_with('}')) return std::nullopt;
  const std::size_t begin = start + before_text.size();
  const std::string_view text = line.substr(begin, line.size() - begin - 1);
  return line.substr(0, begin) == line_start(kind, text) ? std::optional(text) : std::nullopt;
}

/// A later record of the same run, by process and start, replaces the earlier one.
void keep(RunRecord&& run, std::vector<RunRecord>& runs) {
  const auto known = std::find_if(runs.begin(), runs.end(),
                                  [&](const RunRecord& other) { return is_same_run(run, other); });
  if (known == runs.end()) {
    runs.push_back(std::move(run));
  } else {
    *known = std::move(run);
  }
}

/// Of two lines of one journal the later one counts, whatever the clock said.
void keep(Boxed<Outcome>&& later, Outcomes& own) {
  const auto [known, is_new] = own.try_emplace(later->job);
  if (is_new || !later->exception || known->second->exception) known->second = std::move(later);
}

bool counts_more(const Outcome& one, const Outcome& other) {
  return std::tuple(!one.exception, one.finished_at) >=
         std::tuple(!other.exception, other.finished_at);
}

/// Adds the outcomes that count in one journal to those that count in the journals before it.
void add(Outcomes&& own, Outcomes& all) {
  all.merge(own);
  for (auto& [job, outcome] : own) {  // what is left of it is known from another journal
    Boxed<Outcome>& known = all.at(job);
    if (counts_more(*outcome, *known)) known = std::move(outcome);
  }
}

/// Tells of lines of a journal that cannot be read.
std::string damage_text(const std::string& path, const std::vector<std::size_t>& lines) {
  const std::string first = std::to_string(lines.front());
  return path +
         (lines.size() == 1
              ? ":" + first + ": torn or damaged line, or one of another version"
              : ": " + std::to_string(lines.size()) +
                    " torn or damaged lines, or of another version, the first is line " + first) +
         ", left out; run makes again what is missing";
}

/// Appends what the journal of one shard holds.
void read_journal(const std::string& folder, const std::string& name, Detail detail,
                  JournalReading& reading) {
  const std::string path = journal_path(folder, name);
  Outcomes own;
  std::size_t number = 0;
  std::vector<std::size_t> damaged;
  for_each_line(path, [&](std::string_view line) {
    ++number;
    if (auto outcome = read_journal_line(line, detail)) {
      outcome->shard = name;
      keep(std::move(outcome), own);
    } else if (auto run = read_run_line(line)) {
      reading.last_runs[name] = *run;
      keep(std::move(*run), reading.runs);
    } else {
      damaged.push_back(number);
    }
  });
  const bool is_last_damaged = !damaged.empty() && damaged.back() == number;
  if (is_last_damaged && is_locked(path)) damaged.pop_back();  // it is being written
  if (!damaged.empty()) reading.damage.push_back(damage_text(path, damaged));
  reading.unread += damaged.size();
  add(std::move(own), reading.outcomes);
}

}  // namespace

std::string journal_line(const Outcome& outcome) {
  return line_of(outcome_kind, outcome_text(outcome));
}

std::string journal_line(const RunRecord& run) {
  return line_of(
      run_kind, nlohmann::json(run).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

Boxed<Outcome> read_journal_line(std::string_view line, Detail detail) {
  const auto text = checked_text(outcome_kind, line);
  if (!text) return std::nullopt;
  return outcome_from_text(*text, detail);
}

std::optional<RunRecord> read_run_line(std::string_view line) {
  const auto text = checked_text(run_kind, line);
  if (!text) return std::nullopt;
  try {
    return nlohmann::json::parse(*text).get<RunRecord>();
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;  // whole, but of another version
  }
}

JournalReading read_journals(const std::string& folder, Detail detail) {
  JournalReading reading;
  for (const std::string& name : shards_in(folder)) read_journal(folder, name, detail, reading);
  for (const std::string& path : beds_without_journal(folder)) {
    reading.damage.push_back(path +
                             ": left out, its journal is missing; run makes again what is missing");
    ++reading.unread;
  }
  std::erase_if(reading.runs,
                [](const RunRecord& run) { return run.packings == 0 && !run.ended.empty(); });
  sort_runs(reading.runs);
  return reading;
}

std::optional<RunRecord> last_run_in(const std::string& path) {
  std::optional<RunRecord> last;
  for_each_line(path, [&](std::string_view line) {
    if (auto run = read_run_line(line)) last = std::move(run);
  });
  return last;
}

}  // namespace grainsweep
