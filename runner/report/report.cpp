#include "runner/report/report.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "runner/compare/comparison.hpp"
#include "runner/compare/comparison_table.hpp"
#include "runner/exit_codes.hpp"
#include "runner/report/bed_view.hpp"
#include "runner/report/figures.hpp"
#include "runner/report/gnuplot.hpp"
#include "runner/report/page.hpp"
#include "runner/report/picture.hpp"
#include "runner/report/plots.hpp"
#include "runner/report/sections.hpp"
#include "runner/store/files.hpp"
#include "runner/tables/closing_report.hpp"
#include "runner/text.hpp"

namespace grainsweep {
namespace {

std::string comparison_path(const std::string& folder) { return folder + "/comparison.csv"; }

/// The published values beside the sweep file, a copy of which is kept in the folder for when they
/// are not there. Appends to `missing` which were taken, or why none.
std::optional<Reference> reference_of(const std::string& folder, const Provenance& provenance,
                                      std::vector<std::string>& missing) {
  const std::string sweep_file = sweep_file_of(provenance);
  const std::string beside = reference_beside(sweep_file), kept = kept_reference(folder);
  const bool is_beside = !sweep_file.empty() && file_exists(beside);
  if (!is_beside && !file_exists(kept)) {
    if (!file_exists(comparison_path(folder))) return std::nullopt;
    missing.push_back(
        "report.html has no published values: " +
        (sweep_file.empty() ? "several sweeps have none of their own" : beside + " is not there") +
        "; comparison.csv is left as it was");
    return std::nullopt;
  }
  try {
    Reference reference = read_reference(is_beside ? beside : kept);
    if (is_beside) {
      replace_file(kept, read_file(beside));
    } else {
      missing.push_back("published values are those of the last run, kept in " + kept +
                        (sweep_file.empty() ? "" : ": " + beside + " is not there"));
    }
    return reference;
  } catch (const std::runtime_error& error) {  // of what is in it, or of the file
    missing.push_back("report.html has no published values: " + std::string(error.what()));
    remove_file(comparison_path(folder));
    return std::nullopt;
  }
}

constexpr std::size_t most_beds = 12, most_view_bytes = 4'000'000;

/// The first packing of each group with a stored bed, a settled one if there is any.
std::vector<std::pair<const Group*, const Row*>> stored_beds(const std::vector<Row>& rows,
                                                             const std::vector<Group>& groups) {
  const std::vector<std::size_t> numbers = group_numbers(rows);
  std::vector<const Row*> first_of(groups.size());
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (!rows[k].outcome || rows[k].outcome->stored_bytes == 0) continue;
    const Row*& first = first_of[numbers[k] - 1];
    if (first == nullptr || (is_settled(rows[k]) && !is_settled(*first))) first = &rows[k];
  }
  std::vector<std::pair<const Group*, const Row*>> all;
  for (std::size_t k = 0; k < groups.size(); ++k) {
    if (first_of[k] != nullptr) all.emplace_back(&groups[k], first_of[k]);
  }
  return all;
}

/// The beds that have room in the page; empty if none is stored. Appends to `missing`.
std::string beds_of(const std::string& folder, const GivenUnits& units,
                    const std::vector<Row>& rows, const std::vector<Group>& groups,
                    std::vector<std::string>& missing) {
  BedView view;
  std::size_t bytes = 0, left_out = 0;
  const auto all = stored_beds(rows, groups);
  view.all = all.size();
  for (const auto& [group, row] : evenly_spread(all, most_beds)) {
    const StoredBed bed = read_bed(folder, *row->outcome);
    if (bed.grains.empty()) continue;
    bytes += view_size(bed);
    if (bytes > most_view_bytes) {
      bytes -= view_size(bed);
      ++left_out;
      continue;
    }
    BedFacts facts =
        facts_of(row->job, title_of(*group) + (is_settled(*row) ? "" : " (not settled)"));
    facts.units = units;
    if (view.beds.empty()) {
      view.title = facts.title;
      view.picture = picture_of(bed, picture_width, picture_height);
      view.key = picture_key(bed, facts);
    }
    view.beds.push_back(bed_element(bed, facts));
  }
  if (left_out > 0) {
    missing.push_back(counted(left_out, "bed") +
                      " more would make report.html too large; grainsweep export writes all");
  }
  return view.beds.empty() ? "" : bed_section(view);
}

std::string figures_folder(const std::string& folder) { return folder + "/figures"; }

void remove_drawn(const std::string& folder) {
  remove_figures(figures_folder(folder));
  std::error_code holds_other_files;
  std::filesystem::remove(figures_folder(folder), holds_other_files);
}

/// Adds figures and beds, which take all the time. Appends to `missing`.
void add_drawn_parts(const std::string& folder, const GivenUnits& units,
                     const std::vector<Row>& rows, const Analysis& analysis,
                     const std::vector<Comparison>& comparisons, PageParts& parts,
                     std::vector<std::string>& missing) {
  std::vector<Figure> figures = figures_of(rows, analysis, comparisons, units);
  Drawing drawing = draw(figures, figures_folder(folder));
  for (std::size_t k = 0; k < figures.size(); ++k) {
    parts.figures.push_back({std::move(figures[k]), std::move(drawing.svgs[k])});
  }
  parts.no_figures = drawing.missing;
  if (!drawing.missing.empty()) missing.push_back("report.html: " + drawing.missing);
  parts.bed = beds_of(folder, units, rows, analysis.groups, missing);
}

}  // namespace

std::vector<std::string> write_report(const std::string& folder, const Provenance& provenance,
                                      const std::vector<Row>& rows, const Analysis& analysis,
                                      PageExtent extent) {
  std::vector<std::string> missing;
  const auto reference = reference_of(folder, provenance, missing);
  const std::vector<Comparison> comparisons =
      reference ? compare_with(*reference, analysis) : std::vector<Comparison>();
  if (reference) {
    replace_file(comparison_path(folder), comparison_csv(comparisons, provenance.units));
  }
  PageParts parts;
  parts.title = provenance.sweep_name;
  if (extent == PageExtent::whole) {
    add_drawn_parts(folder, provenance.units, rows, analysis, comparisons, parts, missing);
  } else {
    remove_drawn(folder);
    parts.no_figures =
        "no figures, since the run had to end; grainsweep report " + folder + " draws them";
  }
  parts.summary = summary_section(rows, provenance.units);
  parts.groups = groups_section(analysis.groups, provenance.units);
  parts.components = components_section(analysis.groups, analysis.folder);
  parts.fits = fits_section(analysis.families, provenance.units);
  parts.published = published_section(reference ? reference->source : "", comparisons);
  parts.packings = packings_section(rows, analysis.groups, provenance.units);
  parts.provenance = provenance_section(provenance);
  parts.closing_table = closing_report(provenance, rows, analysis.families,
                                       {"grainsweep", folder, has_grains(folder, rows)});
  replace_file(folder + "/report.html", page_text(parts));
  return missing;
}

void remove_report(const std::string& folder) {
  remove_file(folder + "/report.html");
  remove_file(comparison_path(folder));
  remove_file(kept_reference(folder));
  remove_drawn(folder);
}

}  // namespace grainsweep
