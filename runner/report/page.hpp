// The page of a sweep: one HTML file that needs nothing else and asks nothing of any network.
#pragma once

#include <string>
#include <vector>

#include "runner/report/figure.hpp"

namespace grainsweep {

/// A figure as it stands in the page.
struct DrawnFigure {
  Figure figure;
  std::string svg;  ///< empty where it was not drawn
};

struct PageParts {
  std::string title;                                                   ///< plain text
  std::string summary, groups, fits, published, packings, provenance;  ///< HTML
  std::string components;  ///< likewise; empty without mixtures
  std::vector<DrawnFigure> figures;
  std::string bed;            ///< HTML of the beds that turn; empty if there is none
  std::string no_figures;     ///< which could not be drawn and why, plain text; empty if all are
  std::string closing_table;  ///< as in the terminal, plain text
};

std::string page_text(const PageParts& parts);

}  // namespace grainsweep
