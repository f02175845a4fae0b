// Characters that fonts of this machine have. An SVG is lettered by whoever shows it; gnuplot
// letters a PNG itself, and in place of a character without a glyph it fills half the figure with
// black.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace grainsweep {

/// Ranges of code points, first and last of each, ascending and apart.
using Characters = std::vector<std::pair<char32_t, char32_t>>;

/// The characters of any font in a list with a line per font, its format and its characters in
/// hexadecimal digits: "TrueType 20-7e 3c6". Fonts without outlines are not used for drawing.
Characters characters_of_fonts(std::string_view list);

/// The characters of the fonts that fontconfig finds; where it cannot be asked, the letters of
/// European languages, which almost every font has.
Characters installed_characters();

/// UTF-8 text with a question mark for each character beyond ASCII that is not among `known`.
std::string drawable(std::string_view text, const Characters& known);

}  // namespace grainsweep
