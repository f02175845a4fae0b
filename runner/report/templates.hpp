// The page's files, embedded when the program is built (embed.cmake).
#pragma once

#include <string_view>

namespace grainsweep::templates {

extern const std::string_view head_html;     ///< of both pages, with {{names}} of parts
extern const std::string_view page_html;     ///< with {{names}} of parts
extern const std::string_view page_css;      ///< of the whole page
extern const std::string_view bed_html;      ///< a bed that turns, with {{names}} of parts
extern const std::string_view view_html;     ///< a page of one bed, with {{names}} of parts
extern const std::string_view repeat_js;     ///< draws a mesh many times
extern const std::string_view forces_js;     ///< draws the forces between its grains
extern const std::string_view bed_js;        ///< turns it
extern const std::string_view three_min_js;  ///< three.js, by which bed_js draws
extern const std::string_view tables_js;     ///< sorts and filters the table of packings

}  // namespace grainsweep::templates
