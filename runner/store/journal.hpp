// Finished packings, one line each, in a file of the process that made them.
//
// A line is {"length":<bytes>,"crc32":"<8 hex digits>","outcome":{...}}: valid JSON by itself, with
// length and checksum of the bytes of {...}, whose members are those fields
// (runner/store/fields.hpp) of the journal that the outcome has. Not-a-number and infinities are
// texts. It is written by one write(2) and flushed to the disk before the packing counts as done,
// so that a crash can only tear the last line. A torn or damaged line is dropped, and its packing
// made again.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runner/store/outcome.hpp"

namespace grainsweep {

class Journal {
 public:
  /// Appends to <folder>/journal-<host>-<pid>.jsonl, or makes it with the first line.
  explicit Journal(const std::string& folder);

  /// Returns once the outcome is on the disk. Throws FileError.
  void append(const Outcome& outcome);

 private:
  std::string path_;
};

/// How much of an outcome is read: all of it, or the fields of the summary at its beginning, which
/// takes a tenth of the time.
enum class Detail { whole, summary };

struct JournalReading {
  std::map<std::string, Outcome> outcomes;  ///< by job
  std::vector<std::string> damage;          ///< "out/journal-a-12.jsonl:3: torn or damaged ..."
};

/// All journals in `folder`. Of two outcomes of a job the later one counts, but a result is never
/// replaced by an exception. Throws FileError.
JournalReading read_journals(const std::string& folder, Detail detail = Detail::whole);

/// The line (with its line feed) that holds `outcome`.
std::string journal_line(const Outcome& outcome);

/// The outcome in a line without its line feed; nothing if the line is torn or damaged, or has
/// other members than this version of the program gives it.
std::optional<Outcome> read_journal_line(std::string_view line, Detail detail = Detail::whole);

}  // namespace grainsweep
