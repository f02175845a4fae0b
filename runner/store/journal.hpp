// The finished packings, a line each: the record that all tables are made from.
//
// A line is {"length":<bytes>,"crc32":"<8 hex digits>","outcome":{...}}: valid JSON by itself, with
// length and checksum of the bytes of {...}, whose members are those journal fields
// (runner/store/fields.hpp) that the outcome has. Not-a-number and infinities are texts. It is
// written by one write(2) and flushed to the disk before the packing counts as done, so that a
// crash can only tear the last line. A torn or damaged line is dropped, and the packing then
// missing is made again. Lines with "run" instead of "outcome" say who wrote the journal, at the
// beginning of a run and again at its end.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "runner/store/boxed.hpp"
#include "runner/store/outcome.hpp"
#include "runner/store/run_record.hpp"

namespace grainsweep {

/// How much of an outcome is read: all of it, or the fields of the summary at its beginning, which
/// takes a tenth of the time.
enum class Detail { whole, summary };

/// By job. An outcome has more than a kilobyte: it stays where it was read.
using Outcomes = std::unordered_map<std::string, Boxed<Outcome>>;

struct JournalReading {
  Outcomes outcomes;
  std::vector<RunRecord> runs;                 ///< that made something, in the order they started
  std::map<std::string, RunRecord> last_runs;  ///< by shard
  std::vector<std::string> damage;  ///< "out/shards/1-of-1.jsonl:3: torn or damaged ...", by file
  std::size_t unread = 0;           ///< lines and files that it tells of
};

/// The journals of all shards in `folder`. If a job has two outcomes, the later line counts within
/// a journal, and between two journals the one that finished later; but a result is never replaced
/// by an exception. A line that a runner is just writing is left out. Throws FileError.
JournalReading read_journals(const std::string& folder, Detail detail = Detail::whole);

/// The last run in a journal, at work or ended.
std::optional<RunRecord> last_run_in(const std::string& path);

/// The line (with its line feed) that holds `outcome` or `run`.
std::string journal_line(const Outcome& outcome);
std::string journal_line(const RunRecord& run);

/// The outcome in a line without its line feed; nothing if the line is torn or damaged, or has
/// other members than this version of the program gives it.
Boxed<Outcome> read_journal_line(std::string_view line, Detail detail = Detail::whole);
std::optional<RunRecord> read_run_line(std::string_view line);

}  // namespace grainsweep
