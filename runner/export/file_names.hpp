// What exported files are called, and the list of them.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "runner/tables/job_facts.hpp"

namespace grainsweep {

/// For each row the name of its files without their ending: label, number of the group in
/// groups.csv and replicate, as "two_sizes-3-1"; in groups with several seeds also the seed:
/// "two_sizes-3-1-seed5". Every character of a label other than a letter, digit, point or
/// underscore becomes an underscore, and so does a point that would hide the file. No two rows have
/// the same.
std::vector<std::string> file_stems(const std::vector<Row>& rows);

/// index.csv of `folder` without the lines of files that other packings are about to replace:
/// `taken`, file -> job. Nothing if there are no such lines.
std::optional<std::string> index_without(const std::string& folder,
                                         const std::map<std::string, std::string>& taken);

/// Files of `folder` that its index lists of packings whose files of the same ending are `written`
/// now, file -> job, under another name.
std::vector<std::string> superseded(const std::string& folder,
                                    const std::map<std::string, std::string>& written);

/// index.csv: file, job, label, group, replicate, seed, status and unit of length of the files in
/// `folder`: of those `written` now, file -> job, in `unit`, and of others with one of the endings
/// that the present index lists, in the unit that it has for them, if it has one. What that says of
/// a packing which the rows name differently, as after a change of the sweep, stays as it is,
/// unless it is written now: it is listed once for each ending.
std::string index_csv(const std::string& folder, const std::vector<Row>& rows,
                      const std::vector<std::string>& endings,
                      const std::map<std::string, std::string>& written, const std::string& unit);

}  // namespace grainsweep
