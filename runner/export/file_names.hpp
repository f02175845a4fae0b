// What exported files are called, and the list of them.
#pragma once

#include <string>
#include <vector>

#include "runner/tables/job_facts.hpp"

namespace grainsweep {

/// Of each row the name of its files without their ending: label, number of the group in groups.csv
/// and replicate, as "two_sizes-3-1". What is no letter, digit, point, or underscore of a label is
/// an underscore. No two rows have the same.
std::vector<std::string> file_stems(const std::vector<Row>& rows);

/// index.csv: file, job, label, group and replicate of every file in `folder` that is one of the
/// rows' with one of the endings.
std::string index_csv(const std::string& folder, const std::vector<Row>& rows,
                      const std::vector<std::string>& endings);

}  // namespace grainsweep
