#include "runner/export/file_names.hpp"

#include <algorithm>
#include <cctype>
#include <map>
#include <set>
#include <string_view>
#include <unordered_set>

#include "runner/store/files.hpp"
#include "runner/sweep/text_lines.hpp"
#include "runner/tables/csv.hpp"
#include "runner/tables/groups.hpp"

namespace grainsweep {
namespace {

/// A letter for each character of UTF-8.
std::string as_file_name(const std::string& label) {
  std::string name;
  for (const char letter : label) {
    const bool stays = std::isalnum(static_cast<unsigned char>(letter)) != 0 || letter == '.';
    if (begins_character(letter)) name += stays ? letter : '_';
  }
  if (name.starts_with('.')) name.front() = '_';
  return name;
}

/// Whether each group, by its number less one, has packings of several seeds.
std::vector<bool> have_seeds(const std::vector<Row>& rows,
                             const std::vector<std::size_t>& numbers) {
  std::vector<std::uint64_t> first_seed;
  std::vector<bool> several;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const std::size_t group = numbers[k] - 1;
    if (group == first_seed.size())
      first_seed.push_back(rows[k].job.seed), several.push_back(false);
    if (rows[k].job.seed != first_seed[group]) several[group] = true;
  }
  return several;
}

constexpr const char* index_heading = "file,job,label,group,replicate,seed,status,unit\n";

/// From the first point after the number of the replicate on: ".contacts.csv". Labels may have
/// points, too, but no hyphen behind them.
std::string ending_of(const std::string& file) {
  return file.substr(std::min(file.size(), file.find('.', file.rfind('-') + 1)));
}

/// The second cell of a line of a file.
std::string job_in(const std::string& file, const std::string& line) {
  const std::size_t job = file.size() + 1;
  return line.substr(job, line.find(',', job) - job);
}

bool is_line_of(const std::string& line, const std::string& file, const std::string& job) {
  return line.starts_with(file + "," + job + ",");
}

/// The last cell of a line.
std::string unit_in(const std::string& line) { return line.substr(line.rfind(',') + 1); }

/// The lines of the existing index of a folder, by their files. In an index of an earlier version,
/// which has no units, their last cells are empty.
std::map<std::string, std::string> index_lines(const std::string& folder) {
  std::map<std::string, std::string> lines;
  const std::string path = folder + "/index.csv";
  if (!file_exists(path)) return lines;
  bool has_units = true;
  for_each_line(path, [&](std::string_view line) {
    const std::string file(line.substr(0, line.find(',')));
    if (file == "file") {
      has_units = line.ends_with(",unit");
    } else {
      lines[file] = std::string(line) + (has_units ? "" : ",");
    }
  });
  return lines;
}

/// Those with a file of that ending, of the packings of these files.
class HaveFiles {
 public:
  explicit HaveFiles(const std::map<std::string, std::string>& written) {
    for (const auto& [file, job] : written) have_.emplace(job, ending_of(file));
  }
  /// Whether the packing of a line of an index has a file of the ending that the line's one has.
  bool holds(const std::string& file, const std::string& line) const {
    return have_.contains({job_in(file, line), ending_of(file)});
  }

 private:
  std::set<std::pair<std::string, std::string>> have_;  // job and ending
};

}  // namespace

std::vector<std::string> file_stems(const std::vector<Row>& rows) {
  const std::vector<std::size_t> numbers = group_numbers(rows);
  const std::vector<bool> several_seeds = have_seeds(rows, numbers);
  std::vector<std::string> stems;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const JobFacts& job = rows[k].job;
    stems.push_back(as_file_name(job.label) + "-" + cell(numbers[k]) + "-" + cell(job.replicate));
    if (several_seeds[numbers[k] - 1]) stems.back() += "-seed" + cell(job.seed);
  }
  return stems;
}

std::optional<std::string> index_without(const std::string& folder,
                                         const std::map<std::string, std::string>& taken) {
  std::string text = index_heading;
  bool is_changed = false;
  for (const auto& [file, line] : index_lines(folder)) {
    const auto by = taken.find(file);
    const bool is_of_another = by != taken.end() && !is_line_of(line, file, by->second);
    is_changed = is_changed || is_of_another;
    if (!is_of_another) text += line + "\n";
  }
  return is_changed ? std::optional(text) : std::nullopt;
}

std::vector<std::string> superseded(const std::string& folder,
                                    const std::map<std::string, std::string>& written) {
  const HaveFiles have(written);
  std::vector<std::string> files;
  for (const auto& [file, line] : index_lines(folder)) {
    const bool is_other = !written.contains(file) && have.holds(file, line);
    if (is_other && file_exists(folder + "/" + file)) files.push_back(file);
  }
  return files;
}

std::string index_csv(const std::string& folder, const std::vector<Row>& rows,
                      const std::vector<std::string>& endings,
                      const std::map<std::string, std::string>& written, const std::string& unit) {
  const std::vector<std::string> stems = file_stems(rows);
  const std::vector<std::size_t> numbers = group_numbers(rows);
  const std::vector<std::string> names = files_in(folder, "", "");
  const std::unordered_set<std::string> there(names.begin(), names.end());
  std::map<std::string, std::string> listed = index_lines(folder);
  std::string text = index_heading;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    for (const std::string& ending : endings) {
      const std::string file = stems[k] + ending;
      if (!there.contains(file)) continue;
      const JobFacts& job = rows[k].job;
      const auto line = listed.find(file);
      const bool is_its = line != listed.end() && is_line_of(line->second, file, job.id);
      if (!written.contains(file) && !is_its) continue;
      const std::string its_unit = written.contains(file) ? unit : unit_in(line->second);
      if (line != listed.end()) listed.erase(line);
      text += csv_line({cell(file), job.id, cell(job.label), cell(numbers[k]), cell(job.replicate),
                        cell(job.seed), status_of(rows[k]), its_unit});
    }
  }
  const HaveFiles have(written);
  for (const auto& [file, line] : listed) {
    if (there.contains(file) && !have.holds(file, line)) text += line + "\n";
  }
  return text;
}

}  // namespace grainsweep
