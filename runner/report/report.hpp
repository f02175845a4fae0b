// report.html and the folder figures/: what a sweep found, to look at.
#pragma once

#include <string>
#include <vector>

#include "runner/tables/families.hpp"
#include "runner/tables/provenance.hpp"

namespace grainsweep {

/// Writes <folder>/report.html, and <folder>/figures, of rows with their curves. Returns what is
/// missing from it and why, lines for people; nothing if it is whole. Throws FileError.
std::vector<std::string> write_report(const std::string& folder, const Provenance& provenance,
                                      const std::vector<Row>& rows, const Analysis& analysis);

/// Removes what write_report writes.
void remove_report(const std::string& folder);

}  // namespace grainsweep
