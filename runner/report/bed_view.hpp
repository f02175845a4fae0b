// Beds that a browser turns: their grains as the page's script reads them.
#pragma once

#include <string>
#include <vector>

#include "runner/store/states.hpp"
#include "runner/tables/job_facts.hpp"
#include "runner/tables/units.hpp"

namespace grainsweep {

/// What is said of a bed besides its grains.
struct BedFacts {
  std::string title;
  double small_limit = 0.0;  ///< grains of a smaller radius are small, d; 0 if all are of one kind
  GivenUnits units = {};     ///< of the lengths shown; d where there are none
  std::vector<std::string> components = {};  ///< names, of a mixture
};

/// The facts of a packing's bed, with this title.
BedFacts facts_of(const JobFacts& job, const std::string& title);

/// A script element that holds the bed as JSON, its grains in base64. Places are rounded to a
/// 65535th of the box's longest side, radii, forces and orientations likewise: to look at, not to
/// compute with.
std::string bed_element(const StoredBed& bed, const BedFacts& facts);

/// Bytes that the grains of a bed take in the page.
std::size_t view_size(const StoredBed& bed);

/// Pixels of the picture.
inline constexpr int picture_width = 1200, picture_height = 790;

struct BedView {
  std::string title;              ///< of the first bed
  std::string picture;            ///< PNG of it
  std::string key;                ///< as from picture_key
  std::vector<std::string> beds;  ///< as from bed_element
  std::size_t all = 0;            ///< how many there are, with those that are left out
};

/// What the colours of the picture stand for, as HTML.
std::string picture_key(const StoredBed& bed, const BedFacts& facts);

/// The picture, the controls and the beds.
std::string bed_section(const BedView& view);

/// A page of this bed alone.
std::string bed_page(const StoredBed& bed, const BedFacts& facts);

/// The scripts that turn the beds, three.js among them.
std::string bed_scripts();

}  // namespace grainsweep
