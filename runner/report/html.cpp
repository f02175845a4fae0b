#include "runner/report/html.hpp"

#include <cstdint>

#include "runner/report/templates.hpp"
#include "runner/text.hpp"

namespace grainsweep {
namespace {

/// What stands for a character that may not stand for itself; empty if it may.
std::string_view stand_in(char c) {
  switch (c) {
    case '&':
      return "&amp;";
    case '<':
      return "&lt;";
    case '>':
      return "&gt;";
    case '"':
      return "&quot;";
    case '\'':
      return "&#39;";
    case '\n':
    case '\t':
      return "";
    default:
      return static_cast<unsigned char>(c) < 0x20 || c == 0x7F ? "\xEF\xBF\xBD" : "";
  }
}

std::string heading_cell(const Heading& heading) {
  const std::string meaning =
      heading.meaning.empty() ? "" : " title=\"" + html_text(heading.meaning) + "\"";
  return "<th scope=\"col\"" + meaning + ">" + html_text(heading.title) + "</th>";
}

/// No line ends between a value and its error.
std::string with_bound_errors(const std::string& cell) {
  return replaced(cell, " ± ", "\u00A0±\u00A0");
}

std::string table_row(const std::vector<std::string>& cells) {
  std::string text = "<tr>";
  for (std::size_t k = 0; k < cells.size(); ++k) {
    const std::string cell = with_bound_errors(cells[k]);
    text += k == 0 ? "<th scope=\"row\">" + cell + "</th>" : "<td>" + cell + "</td>";
  }
  return text + "</tr>\n";
}

}  // namespace

std::string html_text(std::string_view text) {
  std::string escaped;
  escaped.reserve(text.size());
  for (const char c : text) {
    const std::string_view instead = stand_in(c);
    if (instead.empty())
      escaped += c;
    else
      escaped += instead;
  }
  return escaped;
}

std::string json_in_script(const std::string& json) {
  std::string safe;
  safe.reserve(json.size());
  for (const char c : json) {
    if (c == '<')
      safe += "\\u003c";
    else
      safe += c;
  }
  return safe;
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t at = 0; at < bytes.size(); at += 3) {
    std::uint32_t three = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      three = three << 8u;
      if (at + k < bytes.size()) three |= static_cast<unsigned char>(bytes[at + k]);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      const bool is_padding = at + k > bytes.size();
      text += is_padding ? '=' : digits[(three >> (18u - 6u * k)) & 63u];
    }
  }
  return text;
}

std::string data_uri(std::string_view media_type, std::string_view bytes) {
  return "data:" + std::string(media_type) + ";base64," + base64(bytes);
}

std::string filled(std::string_view page, const std::map<std::string, std::string>& parts) {
  std::string text;
  while (true) {
    const std::size_t open = page.find("{{");
    if (open == std::string_view::npos) return text.append(page);
    const std::size_t close = page.find("}}", open);
    text.append(page.substr(0, open));
    text += parts.at(std::string(page.substr(open + 2, close - open - 2)));
    page.remove_prefix(close + 2);
  }
}

std::string with_signs(const std::string& text) { return replaced(text, " +- ", " ± "); }

std::string html_table(const HtmlTable& table) {
  std::string text = "<div class=\"wide\" tabindex=\"0\" role=\"region\" aria-label=\"" +
                     html_text(table.caption) + "\">\n<table id=\"" + html_text(table.id) +
                     "\">\n<caption>" + html_text(table.caption) + "</caption>\n<thead><tr>";
  for (const Heading& heading : table.headings) text += heading_cell(heading);
  text += "</tr></thead>\n<tbody>\n";
  for (const auto& row : table.rows) text += table_row(row);
  return text + "</tbody>\n</table>\n</div>\n";
}

std::string html_head(const std::string& title) {
  return filled(templates::head_html,
                {{"title", html_text(title)}, {"style", std::string(templates::page_css)}});
}

std::string note_paragraph(std::string_view text) {
  return "<p class=\"note\">" + html_text(text) + "</p>\n";
}

}  // namespace grainsweep
