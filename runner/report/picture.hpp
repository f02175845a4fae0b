// A bed as a picture: what stands in the page until a browser turns it, and on paper.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "runner/store/states.hpp"

namespace grainsweep {

using Colour = std::array<double, 3>;  ///< red, green and blue, from 0 to 255

/// Colours from the smallest grains to the largest, evenly apart, as in templates/bed.js.
const std::vector<Colour>& size_colours();

/// The colour of grains that are all of one size.
Colour colour_of_one_size();

/// Colours for the components of a mixture, as in bed.js; there are eight, then the first again.
Colour component_colour(std::size_t component);

/// The bed seen from above one of its edges, without perspective, coloured by size: a PNG of so
/// many pixels; a mixture by component. A bed without grains gives a white picture.
std::string picture_of(const StoredBed& bed, int width, int height);

/// A PNG of 8-bit RGB pixels, row by row from above.
std::string png_of(const std::string& pixels, int width, int height);

}  // namespace grainsweep
