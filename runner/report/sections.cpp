#include "runner/report/sections.hpp"

#include <algorithm>
#include <numeric>

#include "runner/report/html.hpp"
#include "runner/store/fields.hpp"
#include "runner/tables/components.hpp"
#include "runner/tables/fits.hpp"
#include "runner/tables/units.hpp"
#include "runner/text.hpp"

namespace grainsweep {
namespace {

std::string mean_text(const Spread& spread, int decimals) {
  return with_error(spread.mean, spread.error, decimals);
}

std::string measured(const Row& row, std::string_view name, int decimals) {
  return is_measured(row) ? fixed(number_of(field_named(name), *row.outcome), decimals) : "-";
}

Heading heading(const char* title, std::string_view field) {
  return {title, std::string(field_named(field).meaning)};
}

constexpr const char* gap_or_diameter = "gap between the walls, or diameter of the tube";

Heading extent_heading(const std::vector<Group>& groups, const std::string& unit) {
  return {extent_symbol(groups) + " / " + unit, gap_or_diameter};
}

/// A fitted length in d, and in the unit of the sweep where it has one.
void append_length(const Estimate& length, int decimals, const GivenUnits& units,
                   std::vector<std::string>& cells) {
  cells.push_back(with_error(length.value, length.error, decimals));
  if (!units) return;
  cells.push_back(
      with_error(units->d * length.value, units->d * length.error, decimals_in(*units, decimals)));
}

std::string settled_of(const StatusCounts& counts) {
  const int all = counts.settled + counts.not_settled + counts.failed + counts.pending;
  return std::to_string(counts.settled) + " of " + std::to_string(all);
}

/// Where columns that only a sweep with units has are placed among those of a group.
constexpr std::ptrdiff_t before_units = 4;

std::vector<std::string> unit_cells(const Group& group, const Units& units) {
  const Spread& phi = mean_of(group, "solid_fraction");
  std::vector<std::string> cells = {length_in(units, group.job.box.width)};
  if (units.density) cells.push_back(bulk_density_text(units, phi.mean, phi.error));
  return cells;
}

std::vector<Heading> unit_headings(const std::vector<Group>& groups, const Units& units) {
  std::vector<Heading> headings = {extent_heading(groups, printed_unit(units))};
  if (units.density) headings.push_back({"bulk density / kg/m³"});
  return headings;
}

std::vector<std::string> group_cells(const Group& group, const GivenUnits& units) {
  const Spread& phi = mean_of(group, "solid_fraction");
  std::vector<std::string> cells = {html_text(title_of(group)),
                                    html_text(settled_of(group.counts)),
                                    mean_text(phi, 4),
                                    with_error(1.0 - phi.mean, phi.error, 4),
                                    mean_text(mean_of(group, "coordination"), 3),
                                    mean_text(mean_of(group, "coordination_with_walls"), 3),
                                    fixed(mean_of(group, "contact_ratio").mean, 4),
                                    power_text(mean_of(group, "overlap_mean").mean),
                                    fixed(mean_of(group, "static_imbalance_mean").mean, 4)};
  if (units) {
    const auto more = unit_cells(group, *units);
    cells.insert(cells.begin() + before_units, more.begin(), more.end());
  }
  return cells;
}

/// "The first 2000 of 9998 packings; all are in packings.csv."; empty if all are shown.
std::string left_out_note(std::size_t shown, std::size_t all, const std::string& what,
                          const std::string& file) {
  if (shown == all) return "";
  return "<p class=\"note\">The first " + std::to_string(shown) + " of " + std::to_string(all) +
         " " + what + "; all are in <a href=\"" + file + "\">" + file + "</a>.</p>\n";
}

std::vector<std::string> component_cells(const Group& group, const ComponentLine& line) {
  std::vector<std::string> cells = {html_text(title_of(group)),
                                    html_text(std::to_string(line.component) + " " + line.name),
                                    html_text(std::to_string(line.other) + " " + line.other_name),
                                    mean_text(line.neighbours, 3), mean_text(line.contacts, 3)};
  for (const Spread& kind : line.contact_kinds) cells.push_back(mean_text(kind, 3));
  cells.insert(cells.end(), {mean_text(line.solid_fraction, 4), mean_text(line.coordination, 3)});
  for (const Spread& order : line.nematic) cells.push_back(mean_text(order, 3));
  return cells;
}

std::vector<std::string> fit_cells(const Family& family, Quantity quantity,
                                   const GivenUnits& units) {
  const bool is_phi = quantity == Quantity::solid_fraction;
  const int decimals = is_phi ? 4 : 3;
  const WallFit fit = fit_walls(family, quantity);
  std::vector<std::string> cells = {
      html_text(family.name), is_phi ? "φ" : "Z",
      std::to_string(fit.widths) +
          (fit.narrow_widths > 0 ? " of " + std::to_string(fit.widths + fit.narrow_widths) : "")};
  if (!fit.not_determined.empty()) {
    cells.insert(cells.end(), units ? 7 : 5, "-");
    cells.push_back("not determined: " + html_text(fit.not_determined));
    return cells;
  }
  const std::string unconfined =
      !family.unconfined ? "-" : mean_text(spread_of(*family.unconfined, quantity), decimals);
  cells.insert(cells.end(), {with_error(fit.bulk.value, fit.bulk.error, decimals), unconfined});
  append_length(fit.slope, decimals - 1, units, cells);
  append_length(fit.zeta, 3, units, cells);
  cells.insert(cells.end(), {fixed_or_power(fit.chi2_per_dof, 2), html_text(fit.doubt)});
  return cells;
}

/// Whether all its packings between walls have one width, which gives no line.
bool has_one_width(const Family& family) {
  return family.walled.front().job.box.width == family.walled.back().job.box.width;
}

/// Families of one width have no row each: a random design has a family for each point.
std::string one_width_note(std::size_t families, const std::string& extent) {
  if (families == 0) return "";
  return note_paragraph(
      "No line for " +
      (families == 1 ? "1 family, whose" : cell(families) + " families, each of whose") +
      " packings have one " + extent + ": a line needs 3 or more.");
}

/// Those that did not settle come first.
int order_of(const Row& row) {
  if (!row.outcome) return 2;
  if (is_settled(row)) return 3;
  return row.outcome->result.status == PackingStatus::failed ? 0 : 1;
}

/// `title`: what tells the group of the packing from the others.
std::vector<std::string> packing_cells(const Row& row, const std::string& title,
                                       const GivenUnits& units) {
  const JobFacts& job = row.job;
  const std::string reason = html_text(row.outcome ? row.outcome->result.reason : "");
  const std::string remedy = html_text(remedy_of(row));
  std::vector<std::string> cells = {"<code>" + html_text(job.id) + "</code>",
                                    "<span class=\"status " + html_text(status_of(row)) + "\">" +
                                        html_text(status_words(row)) + "</span>",
                                    html_text(title),
                                    cell(job.box.width),
                                    std::to_string(job.replicate),
                                    row.outcome ? std::to_string(row.outcome->result.grains) : "-",
                                    measured(row, "solid_fraction", 4),
                                    measured(row, "coordination", 3),
                                    measured(row, "contact_ratio", 4),
                                    measured(row, "static_imbalance_mean", 4),
                                    row.outcome ? fixed(row.outcome->cpu_seconds, 2) : "-",
                                    reason + (reason.empty() || remedy.empty() ? "" : "<br>") +
                                        (remedy.empty() ? "" : "<em>What to do:</em> " + remedy)};
  if (units) cells.insert(cells.begin() + 4, length_in(*units, job.box.width));
  return cells;
}

std::string published_value(const Published& published) {
  return published.text + (published.definition.empty() ? "" : " (" + published.definition + ")");
}

std::string measured_value(const Measured& measured) {
  if (!measured.not_determined.empty()) {
    return "not determined: " + with_signs(measured.not_determined);
  }
  return with_error(measured.estimate.value, measured.estimate.error, 4) +
         (measured.definition.empty() ? "" : " (" + measured.definition + ")");
}

std::string definition(const std::string& term, const std::string& text) {
  return text.empty() ? "" : "<dt>" + term + "</dt><dd>" + html_text(text) + "</dd>\n";
}

std::string build_list(const Build& build) {
  std::string libraries;
  for (const auto& [name, version] : build.libraries) {
    libraries += (libraries.empty() ? "" : ", ") + name + " " + version;
  }
  return "<dl>\n" + definition("Program", "grainsweep " + build.version) +
         definition("Commit", build.commit) + definition("Compiler", build.compiler) +
         definition("Libraries", libraries) + "</dl>\n";
}

std::vector<std::string> run_cells(const RunRecord& run) {
  return {html_text(run.started),
          run.ended.empty() ? "not ended" : html_text(duration_text(run.wall_seconds)),
          run.ended.empty() ? "not known" : std::to_string(run.packings),
          html_text(run.host),
          html_text(run.processor),
          std::to_string(run.threads) + " of " + std::to_string(run.cores),
          html_text(run.isa),
          html_text(run.commit),
          "<code>" + html_text(run.command) + "</code>"};
}

}  // namespace

std::string summary_section(const std::vector<Row>& rows, const GivenUnits& units) {
  const Totals totals = totals_of(rows);
  const StatusCounts& counts = totals.counts;
  std::string text =
      counted(rows.size(), "packing") + ", " + std::to_string(counts.settled) + " settled";
  const auto add = [&](int count, const char* what) {
    if (count > 0) text += ", " + std::to_string(count) + " " + what;
  };
  add(counts.not_settled, "not settled");
  add(counts.failed, "failed");
  add(counts.pending, "not made yet");
  text += "; processor time " + duration_text(totals.cpu_seconds) + ".";
  if (units) text += " Lengths are in d; " + units_text(*units) + ".";
  if (counts.settled != static_cast<int>(rows.size())) {
    text +=
        " Only settled packings enter means, fits and curves; the table of packings says what "
        "became of the others.";
  }
  return "<p class=\"summary\">" + html_text(text) + "</p>\n";
}

std::string groups_section(const std::vector<Group>& groups, const GivenUnits& units) {
  HtmlTable table{"groups", "Means and their standard errors", {}, {}};
  table.headings = {{"parameters", "label and what differs within the sweep"},
                    {"settled", "packings that enter the means"},
                    heading("φ", "solid_fraction"),
                    {"porosity", "1 - φ"},
                    heading("Z", "coordination"),
                    heading("Z with walls", "coordination_with_walls"),
                    heading("contacts / isostatic", "contact_ratio"),
                    heading("overlap / d", "overlap_mean"),
                    heading("imbalance", "static_imbalance_mean")};
  if (units) {
    const auto more = unit_headings(groups, *units);
    table.headings.insert(table.headings.begin() + before_units, more.begin(), more.end());
  }
  const std::size_t shown = std::min(most_groups, groups.size());
  for (std::size_t k = 0; k < shown; ++k) table.rows.push_back(group_cells(groups[k], units));
  return left_out_note(shown, groups.size(), "parameter sets", "groups.csv") + html_table(table);
}

std::string components_section(const std::vector<Group>& groups, const std::string& folder) {
  HtmlTable table{"components", "Components of mixtures, a row for each pair", {}, {}};
  table.headings = {{"parameters", "label and what differs within the sweep"},
                    {"component", "its number in the mixture, and its shape"},
                    {"other", "the component whose grains it touches"},
                    {"neighbours", "grains of the other that one of the component touches"},
                    {"contacts", "share of the force-bearing contacts that join the two"},
                    {"at a point", "share of those"},
                    {"along a line", "share of those"},
                    {"over an area", "share of those"},
                    {"φ", "solid fraction of the component"},
                    {"Z", "grains of any component that one of the component touches"},
                    {"nematic x", "nematic order of the axis x of the component's frame"},
                    {"nematic y", "the same of y"},
                    {"nematic z", "the same of z"}};
  std::size_t shown = 0, all = 0;
  for (const Group& group : groups) {
    if (!is_mixture(group.job) || group.settled.empty() || ++all > most_mixtures_of_page) continue;
    ++shown;
    const GroupWithCurves with_curves(group, folder);
    for (const ComponentLine& line : mean_components(*with_curves)) {
      table.rows.push_back(component_cells(group, line));
    }
  }
  if (table.rows.empty()) return "";
  const std::string left_out =
      shown == all
          ? ""
          : note_paragraph("The first " + std::to_string(shown) + " of " + std::to_string(all) +
                           " mixtures; all are in the folder's components.csv.");
  return left_out + html_table(table);
}

std::string fits_section(const std::vector<Family>& families, const GivenUnits& units) {
  const std::string extent = extent_symbol(families);
  HtmlTable table{"fits",
                  "Wall effect: φ = φ_bulk - C / " + extent + " and Z = Z_bulk - C_Z / " + extent,
                  {},
                  {}};
  table.headings = {{"family"},
                    {"of"},
                    {"widths"},
                    {"bulk", "the value without walls along y, from the line"},
                    {"periodic", "measured without walls"},
                    {"C / d", "slope of the line"}};
  if (units) table.headings.push_back({"C / " + printed_unit(*units), "slope of the line"});
  table.headings.push_back({"ζ / d", "slope over bulk value"});
  if (units) table.headings.push_back({"ζ / " + printed_unit(*units), "slope over bulk value"});
  table.headings.push_back({"χ²/dof", "about 1 if the line holds"});
  table.headings.push_back({"remark"});
  std::size_t of_one_width = 0;
  for (const Family& family : families) {
    if (family.walled.empty()) continue;
    if (has_one_width(family)) {
      ++of_one_width;
      continue;
    }
    for (const Quantity quantity : {Quantity::solid_fraction, Quantity::coordination}) {
      table.rows.push_back(fit_cells(family, quantity, units));
    }
  }
  return one_width_note(of_one_width, extent) + (table.rows.empty() ? "" : html_table(table));
}

std::string published_section(const std::string& source,
                              const std::vector<Comparison>& comparisons) {
  if (comparisons.empty()) return "";
  HtmlTable table{"published-values", source, {}, {}};
  table.headings = {{"family"}, {"quantity"}, {"published"}, {"measured"}, {"verdict"}};
  for (const Comparison& one : comparisons) {
    table.rows.push_back(
        {html_text(one.family), html_text(one.title), html_text(published_value(one.published)),
         html_text(one.along.empty() ? measured_value(one.measured)
                                     : counted(one.along.size(), name_of_each(one.published))),
         html_text(verdict(one))});
  }
  return html_table(table);
}

std::string packings_section(const std::vector<Row>& rows, const std::vector<Group>& groups,
                             const GivenUnits& units) {
  std::vector<std::string> titles;  // in the order of the groups' numbers
  titles.reserve(groups.size());
  for (const Group& group : groups) titles.push_back(title_of(group));
  const std::vector<std::size_t> numbers = group_numbers(rows);
  HtmlTable table{"packings", "Packings, those that did not settle first", {}, {}};
  table.headings = {{"packing", "column job of the tables"},
                    {"status"},
                    {"parameters", "label and what differs within the sweep"},
                    extent_heading(groups, "d"),
                    {"replicate"},
                    heading("grains", "grains"),
                    heading("φ", "solid_fraction"),
                    heading("Z", "coordination"),
                    heading("contacts / isostatic", "contact_ratio"),
                    heading("imbalance", "static_imbalance_mean"),
                    heading("CPU / s", "cpu_seconds"),
                    {"reason"}};
  if (units)
    table.headings.insert(table.headings.begin() + 4, extent_heading(groups, printed_unit(*units)));
  std::vector<std::size_t> sorted(rows.size());
  std::iota(sorted.begin(), sorted.end(), std::size_t{0});
  std::stable_sort(sorted.begin(), sorted.end(), [&](std::size_t a, std::size_t b) {
    return order_of(rows[a]) < order_of(rows[b]);
  });
  const std::size_t shown = std::min(most_packings, sorted.size());
  for (std::size_t k = 0; k < shown; ++k) {
    const std::size_t at = sorted[k];
    table.rows.push_back(packing_cells(rows[at], titles[numbers[at] - 1], units));
  }
  return left_out_note(shown, sorted.size(), "packings", "packings.csv") + html_table(table);
}

std::string remedy_of(const Row& row) {
  if (!row.outcome) return "run the sweep again, unless it runs now: it makes what is missing";
  if (is_settled(row)) return "";
  if (row.outcome->exception) return "run the sweep again: packings that broke off are made anew";
  if (row.outcome->result.status == PackingStatus::failed) {
    return "mend what the reason names in the sweep file, and run it again";
  }
  return "as the reason says, or take more accurate steps (accuracy.path_tolerance); where few of "
         "many do not settle, the others stand for the parameters";
}

std::string provenance_section(const Provenance& provenance) {
  HtmlTable runs{"runs", "Runs", {}, {}};
  runs.headings = {{"started"}, {"took"},    {"packings"}, {"host"},   {"processor"},
                   {"threads"}, {"kernels"}, {"commit"},   {"command"}};
  for (const RunRecord& run : provenance.runs) runs.rows.push_back(run_cells(run));
  std::string text = build_list(provenance.build) + html_table(runs);
  for (const SweepFile& sweep : provenance.sweeps) {
    text += "<details><summary>Sweep file " + html_text(sweep.file) +
            ", verbatim</summary>\n<pre tabindex=\"0\">" + html_text(sweep.text) +
            "</pre></details>\n";
  }
  return text;
}

}  // namespace grainsweep
