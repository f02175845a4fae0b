// report.html and the folder figures/: what a sweep found, to look at.
#pragma once

#include <string>
#include <vector>

#include "runner/tables/families.hpp"
#include "runner/tables/provenance.hpp"

namespace grainsweep {

/// How much of a page is written.
enum class PageExtent {
  whole,
  text,  ///< at once: no figures and no beds, for a run that has to end
};

/// Writes <folder>/report.html, and <folder>/figures, of rows whose beds were checked, in the place
/// of earlier ones. Returns what is missing from a whole page and why, lines for people; nothing if
/// it is whole. Throws FileError.
std::vector<std::string> write_report(const std::string& folder, const Provenance& provenance,
                                      const std::vector<Row>& rows, const Analysis& analysis,
                                      PageExtent extent = PageExtent::whole);

/// Removes what write_report writes.
void remove_report(const std::string& folder);

}  // namespace grainsweep
