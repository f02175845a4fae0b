// Pieces of an HTML page. Text of users goes through `html_text`, whatever it holds.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace grainsweep {

/// `text` as content or attribute value: markup, quotes and control characters lose their meaning.
std::string html_text(std::string_view text);

/// JSON that may stand in a script element: no "<", so that nothing in it ends the element.
std::string json_in_script(const std::string& json);

/// RFC 4648, with padding.
std::string base64(std::string_view bytes);

/// "data:image/png;base64,..."
std::string data_uri(std::string_view media_type, std::string_view bytes);

/// `page` with each {{name}} replaced by the part called so; parts are not searched for further
/// names. Throws std::out_of_range if a part is missing.
std::string filled(std::string_view page, const std::map<std::string, std::string>& parts);

/// A column's heading; `meaning`, if any, is what a pointer resting on it shows.
struct Heading {
  std::string title;
  std::string meaning = {};
};

struct HtmlTable {
  std::string id;       ///< for scripts and links
  std::string caption;  ///< plain text
  std::vector<Heading> headings;
  std::vector<std::vector<std::string>> rows;  ///< cells, finished HTML
};

/// Plain text with the sign ± where reasons in tables, which are plain ASCII, have "+-".
std::string with_signs(const std::string& text);

/// A table that scrolls sideways where it does not fit, each row headed by its first cell.
std::string html_table(const HtmlTable& table);

/// Everything before the body of a page with this title, plain text: style, and the policy by which
/// it asks nothing of any network.
std::string html_head(const std::string& title);

/// "<p class=\"note\">...</p>" of plain text.
std::string note_paragraph(std::string_view text);

}  // namespace grainsweep
