// The page's files, embedded when the program is built (embed.cmake).
#pragma once

#include <string_view>

namespace grainsweep::templates {

extern const std::string_view page_html;  ///< with {{names}} of parts
extern const std::string_view page_css;   ///< of the whole page
extern const std::string_view tables_js;  ///< sorts and filters the table of packings

}  // namespace grainsweep::templates
