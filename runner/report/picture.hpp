// A bed as a picture: what stands in the page until a browser turns it, and on paper.
#pragma once

#include <string>

#include "runner/store/states.hpp"

namespace grainsweep {

/// The bed seen from above one of its edges, without perspective, coloured by size: a PNG of so
/// many pixels. A bed without grains gives a white picture.
std::string picture_of(const StoredBed& bed, int width, int height);

/// A PNG of 8-bit RGB pixels, row by row from above.
std::string png_of(const std::string& pixels, int width, int height);

}  // namespace grainsweep
