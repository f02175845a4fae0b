#include "runner/store/brief.hpp"

#include <charconv>
#include <cstring>

#include "runner/store/journal.hpp"
#include "runner/store/journal_lines.hpp"

namespace grainsweep {
namespace {

/// The value at the beginning of `text`, up to the next comma or bracket, or without its quotes.
std::string_view value_of(std::string_view text) {
  if (!text.starts_with('"')) return text.substr(0, text.find_first_of(",}]"));
  text.remove_prefix(1);
  return text.substr(0, text.find('"'));
}

/// The value behind `"name":`, and takes all before it from `text`; empty if there is no such
/// member. No string holds such a beginning: in it every quote has a backslash before it. memmem,
/// since a line has a hundred quotes before the one looked for.
std::string_view take_member(std::string_view& text, std::string_view beginning) {
  const void* at = memmem(text.data(), text.size(), beginning.data(), beginning.size());
  if (at == nullptr) return {};
  text.remove_prefix(static_cast<std::size_t>(static_cast<const char*>(at) - text.data()) +
                     beginning.size());
  return value_of(text);
}

Brief brief_of(const Outcome& outcome) {
  return {outcome.job, outcome.version, outcome.result.status, outcome.threw, outcome.cpu_seconds};
}

}  // namespace

std::optional<Brief> read_brief(std::string_view line, std::string_view version) {
  auto text = outcome_in(line);
  if (!text) return std::nullopt;
  // Members are written in the order of their names.
  const std::string_view seconds = take_member(*text, R"("cpu_seconds":)");
  const std::string_view job = take_member(*text, R"("job":)");
  const std::string_view status = take_member(*text, R"("status":)");
  const std::string_view threw = take_member(*text, R"("threw":)");
  const std::string_view written_by = take_member(*text, R"("version":)");
  Brief brief;
  brief.job = job;
  brief.version = version;
  const auto number = std::from_chars(seconds.begin(), seconds.end(), brief.cpu_seconds);
  const bool is_ours = written_by == version && !job.empty() && number.ec == std::errc() &&
                       number.ptr == seconds.end();
  if (!is_ours || status.empty()) {
    const auto outcome = read_journal_line(line);
    return outcome ? std::optional(brief_of(*outcome)) : std::nullopt;
  }
  brief.status = status_from(status);
  brief.threw = threw == "true";
  return brief;
}

BriefReading read_briefs(const std::string& folder, std::string_view version) {
  BriefReading reading;
  const auto read = [&](std::string_view line) { return read_brief(line, version); };
  reading.damage = collect_lines(folder, read, reading.briefs);
  return reading;
}

}  // namespace grainsweep
