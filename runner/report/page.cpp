#include "runner/report/page.hpp"

#include "runner/report/bed_view.hpp"
#include "runner/report/html.hpp"
#include "runner/report/templates.hpp"

namespace grainsweep {
namespace {

/// "A title. A caption": what stands for the picture where it cannot be seen.
std::string alternative(const Figure& figure) {
  return html_text(figure.title + ". " + figure.caption);
}

/// Links to the pictures and tables behind a figure.
std::string links_of(const DrawnFigure& drawn) {
  const Figure& figure = drawn.figure;
  std::string text;
  const auto add = [&](const std::string& file, const std::string& what) {
    text += (text.empty() ? "" : " · ") + ("<a href=\"figures/" + html_text(file) + "\">") +
            html_text(what) + "</a>";
  };
  if (!drawn.svg.empty()) {
    add(figure.name + ".svg", "SVG");
    add(figure.name + ".png", "PNG");
  }
  for (const auto& [name, table] : figure.tables) add(name, name);
  return "<span class=\"links\">" + text + "</span>";
}

std::string figure_section(const DrawnFigure& drawn) {
  const Figure& figure = drawn.figure;
  std::string text = "<figure id=\"figure-" + html_text(figure.name) + "\">\n<h3>" +
                     html_text(figure.title) + "</h3>\n";
  if (!figure.not_drawn.empty()) {
    return text + note_paragraph("Not determined: " + figure.not_drawn + ".") + "</figure>\n";
  }
  if (!drawn.svg.empty()) {
    text += "<div class=\"wide\" tabindex=\"0\" role=\"region\" aria-label=\"" +
            html_text(figure.title) + "\">\n<img width=\"" + std::to_string(figure.width) +
            "\" height=\"" + std::to_string(figure.height) + "\" alt=\"" + alternative(figure) +
            "\" src=\"" + data_uri("image/svg+xml", drawn.svg) + "\">\n</div>\n";
  }
  return text + "<figcaption>" + html_text(figure.caption) + " " + links_of(drawn) +
         "</figcaption>\n</figure>\n";
}

/// A section with its heading; nothing if it is empty.
std::string section(const std::string& id, const std::string& title, const std::string& content) {
  if (content.empty()) return "";
  return "<section id=\"" + id + "\">\n<h2>" + title + "</h2>\n" + content + "</section>\n";
}

std::string figures_section(const PageParts& parts) {
  std::string text;
  if (!parts.no_figures.empty()) text += note_paragraph("Note: " + parts.no_figures + ".");
  for (const DrawnFigure& drawn : parts.figures) text += figure_section(drawn);
  return section("figures", "Figures", text);
}

std::string closing_section(const std::string& table) {
  return "<details><summary>As printed in the terminal</summary>\n<pre tabindex=\"0\">" +
         html_text(table) + "</pre></details>\n";
}

}  // namespace

std::string page_text(const PageParts& parts) {
  return filled(
      templates::page_html,
      {{"head", html_head(parts.title)},
       {"title", html_text(parts.title)},
       {"summary", parts.summary},
       {"figures", figures_section(parts)},
       {"fits", section("wall-effect", "Wall effect", parts.fits)},
       {"bed", section("bed", "Look inside", parts.bed)},
       {"groups", section("means", "Means",
                          parts.groups + parts.components + closing_section(parts.closing_table))},
       {"published", section("published", "Published values", parts.published)},
       {"packings", section("all-packings", "Packings", parts.packings)},
       {"provenance", section("provenance", "How this was made", parts.provenance)},
       {"scripts", (parts.bed.empty() ? "" : bed_scripts()) + "<script>" +
                       std::string(templates::tables_js) + "</script>"}});
}

}  // namespace grainsweep
