#include "runner/export/file_names.hpp"

#include <cctype>
#include <filesystem>

#include "runner/tables/csv.hpp"
#include "runner/tables/groups.hpp"

namespace grainsweep {
namespace {

std::string as_file_name(std::string label) {
  for (char& letter : label) {
    const bool stays = std::isalnum(static_cast<unsigned char>(letter)) != 0 || letter == '.';
    if (!stays) letter = '_';
  }
  return label;
}

}  // namespace

std::vector<std::string> file_stems(const std::vector<Row>& rows) {
  const std::vector<std::size_t> numbers = group_numbers(rows);
  std::vector<std::string> stems;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    stems.push_back(as_file_name(rows[k].job.label) + "-" + cell(numbers[k]) + "-" +
                    cell(rows[k].job.replicate));
  }
  return stems;
}

std::string index_csv(const std::string& folder, const std::vector<Row>& rows,
                      const std::vector<std::string>& endings) {
  const std::vector<std::string> stems = file_stems(rows);
  const std::vector<std::size_t> numbers = group_numbers(rows);
  std::string text = "file,job,label,group,replicate\n";
  for (std::size_t k = 0; k < rows.size(); ++k) {
    for (const std::string& ending : endings) {
      const std::string file = stems[k] + ending;
      if (!std::filesystem::exists(std::filesystem::path(folder) / file)) continue;
      const JobFacts& job = rows[k].job;
      text +=
          csv_line({cell(file), job.id, cell(job.label), cell(numbers[k]), cell(job.replicate)});
    }
  }
  return text;
}

}  // namespace grainsweep
