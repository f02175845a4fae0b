// Published values to compare a sweep with, as a JSON file gives them (see configs/README.md).
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "runner/compare/where.hpp"

namespace grainsweep {

/// The standard error of a published value, as it is or over the value; both 0 if there is none.
struct PublishedError {
  double own = 0.0, relative = 0.0;

  double of(double value) const { return std::max(own, relative * std::abs(value)); }
};

/// A quantity over the gap between walls or the diameter of a tube.
struct PublishedFormula {
  std::string text;  ///< without fault (runner/compare/formula.hpp)
  std::string name;  ///< for keys of figures: what the file has as its text, or the formula
  double from = 0.0, to = std::numeric_limits<double>::infinity();  ///< where it holds, d
  PublishedError error;                                             ///< of its values
};

/// A quantity over the distance from the nearest wall: points, or a formula of them.
struct PublishedProfile {
  std::string name;     ///< for keys of figures: what the file has as its text; may be empty
  std::string formula;  ///< without fault; empty if points are given
  struct Point {
    double distance = 0.0;  ///< from the wall, d
    double value = 0.0;
  };
  std::vector<Point> points;  ///< by distance; none of a formula (see points_at)
  PublishedError error;       ///< of their values
};

/// One published value, in d where it is a length; for some quantities a source has only words.
struct Published {
  std::string quantity;  ///< a name that measure_quantity knows
  double width = 0.0;    ///< gap between the walls at which it holds, d; 0 if it belongs to none
  std::string text;      ///< as printed: "6.027 ± 0.012", "3 to 4", "falls with x_S", or "-"
  /// The value in numbers, low = high if it is a single one; nothing if there is none.
  struct Range {
    double low = 0.0, high = 0.0;
    double error = 0.0;  ///< printed error, 0 if there is none
  };
  std::optional<Range> range;
  std::string definition;                        ///< what the source says of it; may be empty
  std::optional<PublishedFormula> formula = {};  ///< in place of a value at one width
  std::optional<PublishedProfile> profile = {};  ///< in place of a single value at `width`, which
                                                 ///< a formula need not have
};

/// Values of the families that `where` describes.
struct PublishedFamily {
  Where where;
  std::vector<Published> values;
};

struct Reference {
  std::string source;
  std::vector<PublishedFamily> families;
  std::vector<Published> common;  ///< values that the source says to be the same in all families
};

/// Throws BadInput with all that is wrong with the file, line by line, each with its place, and
/// FileError if it cannot be read.
Reference read_reference(const std::string& path);

/// The points of a published profile where the gap or the diameter is `width`, d. A formula gives
/// one every 0.05 d, up to the middle of a gap or the axis of a tube, where it has a value that the
/// quantity can be.
std::vector<PublishedProfile::Point> points_at(double width, const Published& published);

/// Where the published values of a sweep are: "configs/paper.reference.json" for
/// "configs/paper.json".
std::string reference_beside(const std::string& sweep_file);

/// Where an output folder keeps them for when they are no longer there.
std::string kept_reference(const std::string& folder);

}  // namespace grainsweep
