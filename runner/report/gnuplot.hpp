// Draws figures with gnuplot, a program of its own.
#pragma once

#include <string>
#include <vector>

#include "runner/report/figure.hpp"

namespace grainsweep {

struct Drawing {
  std::vector<std::string> svgs;  ///< of each figure; empty where there is nothing to see
  std::string missing;            ///< which pictures are missing and why; empty if none is
};

/// Writes tables and commands into `folder`, from which `gnuplot NAME.gnuplot` draws NAME.svg and
/// NAME.png again, and draws all of them at once, in the place of earlier ones. Throws FileError.
Drawing draw(const std::vector<Figure>& figures, const std::string& folder);

/// "gnuplot 5.4 patchlevel 4"; empty if there is none.
std::string gnuplot_version();

/// Removes all files of figures from the folder, half written ones, too; other files stay.
void remove_figures(const std::string& folder);

}  // namespace grainsweep
