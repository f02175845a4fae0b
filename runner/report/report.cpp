#include "runner/report/report.hpp"

#include <filesystem>
#include <optional>
#include <system_error>

#include "runner/compare/comparison.hpp"
#include "runner/exit_codes.hpp"
#include "runner/report/figures.hpp"
#include "runner/report/gnuplot.hpp"
#include "runner/report/page.hpp"
#include "runner/report/sections.hpp"
#include "runner/store/files.hpp"
#include "runner/tables/closing_report.hpp"

namespace grainsweep {
namespace {

/// The published values beside the sweep file, if there are any that can be read.
std::optional<Reference> reference_of(const Provenance& provenance,
                                      std::vector<std::string>& missing) {
  const std::string sweep_file = sweep_file_of(provenance);
  const std::string beside = reference_beside(sweep_file);
  if (sweep_file.empty() || !file_exists(beside)) return std::nullopt;
  try {
    return read_reference(beside);
  } catch (const BadInput& error) {
    missing.push_back("report.html has no published values: " + std::string(error.what()));
    return std::nullopt;
  }
}

std::string figures_folder(const std::string& folder) { return folder + "/figures"; }

}  // namespace

std::vector<std::string> write_report(const std::string& folder, const Provenance& provenance,
                                      const std::vector<Row>& rows, const Analysis& analysis) {
  std::vector<std::string> missing;
  const auto reference = reference_of(provenance, missing);
  const std::vector<Comparison> comparisons =
      reference ? compare_with(*reference, analysis.families) : std::vector<Comparison>();
  const std::vector<Figure> figures = figures_of(rows, analysis, comparisons);
  PageParts parts;
  parts.title = provenance.sweep_name;
  const Drawing drawing = draw(figures, figures_folder(folder));
  parts.no_figures = drawing.missing;
  if (!drawing.missing.empty()) missing.push_back("report.html: " + drawing.missing);
  for (std::size_t k = 0; k < figures.size(); ++k) {
    parts.figures.push_back({&figures[k], drawing.svgs[k]});
  }
  parts.summary = summary_section(rows);
  parts.groups = groups_section(analysis.groups);
  parts.fits = fits_section(analysis.families);
  parts.published = published_section(reference ? reference->source : "", comparisons);
  parts.packings = packings_section(rows, analysis.groups);
  parts.provenance = provenance_section(provenance);
  parts.closing_table = closing_report(provenance, rows, analysis.families, folder);
  replace_file(folder + "/report.html", page_text(parts));
  return missing;
}

void remove_report(const std::string& folder) {
  remove_file(folder + "/report.html");
  std::error_code is_gone;
  std::filesystem::remove_all(figures_folder(folder), is_gone);
}

}  // namespace grainsweep
