#include "runner/tables/closing_report.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <set>

#include "engine/text.hpp"
#include "runner/store/files.hpp"
#include "runner/store/states.hpp"
#include "runner/tables/csv.hpp"
#include "runner/tables/families.hpp"
#include "runner/tables/fits.hpp"
#include "runner/tables/named_lines.hpp"
#include "runner/tables/packing_names.hpp"
#include "runner/tables/sizes.hpp"
#include "runner/tables/units.hpp"
#include "runner/text.hpp"

namespace grainsweep {
namespace {

constexpr int solid_fraction_decimals = 4;
constexpr int coordination_decimals = 3;

/// "3 of 5 settled" where some are missing, else "3".
std::string packings_text(const Group& group) {
  const StatusCounts& counts = group.counts;
  const int all = counts.settled + counts.not_settled + counts.failed + counts.pending;
  const std::string settled = std::to_string(counts.settled);
  return counts.settled == all ? settled : settled + " of " + std::to_string(all);
}

/// The columns of a table: their heads, and the cells of a group.
struct TableColumns {
  std::vector<std::string> heads;
  std::function<std::vector<std::string>(const Group&)> cells;
};

std::vector<std::string> measured_cells(const Group& group) {
  const Box& box = group.job.box;
  const Spread& phi = mean_of(group, "solid_fraction");
  const Spread& z = mean_of(group, "coordination");
  return {width_text(cell(box.width), box.y),
          with_error(phi.mean, phi.error, solid_fraction_decimals),
          with_error(z.mean, z.error, coordination_decimals),
          fixed(mean_of(group, "contact_ratio").mean, 4),
          power_text(mean_of(group, "overlap_mean").mean),
          packings_text(group)};
}

/// A line of a table: a group, and what tells its family from others in the table.
struct TableLine {
  std::string name;
  const Group* group = nullptr;
};

void append_lines(const Family& family, std::vector<TableLine>& lines) {
  for (const Group& group : family.walled) lines.push_back({family.distinction, &group});
  for (const Group& group : family.periodic) lines.push_back({family.distinction, &group});
}

std::string extent_in(const std::vector<TableLine>& lines) {
  return extent_symbol(lines, [](const TableLine& line) -> const Group& { return *line.group; });
}

/// What is measured.
TableColumns measured_columns(const std::vector<TableLine>& lines) {
  return {{pad_right(extent_in(lines) + "/d", 11), pad_left("φ ± error", 15),
           pad_left("Z ± error", 14), "contacts/iso", "overlap/d", "packings"},
          measured_cells};
}

/// The same in the units of the sweep.
TableColumns laboratory_columns(const std::vector<TableLine>& lines, const Units& units) {
  TableColumns columns;
  columns.heads = {pad_right(extent_in(lines) + "/" + printed_unit(units), 13),
                   pad_left("porosity ± error", 18)};
  if (units.density) columns.heads.push_back(pad_left("kg/m³ ± error", 15));
  columns.cells = [=](const Group& group) {
    const Spread& phi = mean_of(group, "solid_fraction");
    const Box& box = group.job.box;
    std::vector<std::string> cells = {
        width_text(length_in(units, box.width), box.y),
        with_error(1.0 - phi.mean, phi.error, solid_fraction_decimals)};
    if (units.density) cells.push_back(bulk_density_text(units, phi.mean, phi.error));
    return cells;
  };
  return columns;
}

/// The first of the lines below the heads of their columns.
std::string table_text(const std::vector<TableLine>& lines, const TableColumns& columns) {
  constexpr std::size_t most_lines = 60;
  std::vector<NamedLine> first;
  for (const TableLine& line : lines) {
    if (first.size() < most_lines) first.push_back({line.name, columns.cells(*line.group)});
  }
  std::string text = named_lines("", columns.heads, first);
  if (lines.size() <= most_lines) return text;
  return text + "  and " + std::to_string(lines.size() - most_lines) + " more, see groups.csv\n";
}
std::string table_text(const std::vector<TableLine>& lines) {
  return table_text(lines, measured_columns(lines));
}

std::string reference_text(const Family& family, Quantity quantity, int decimals) {
  if (!family.unconfined) return "";
  const Spread& spread = spread_of(*family.unconfined, quantity);
  return "; periodic " + with_error(spread.mean, spread.error, decimals);
}

/// " ± 0.0020 protocol", the second error of a mean; nothing where it was not measured.
std::string protocol_text(const WallFit& fit, int decimals) {
  return fit.bias_bound ? " ± " + fixed(*fit.bias_bound, decimals) + " protocol" : "";
}

/// How good the line is, in brackets.
std::string quality_text(const WallFit& fit) {
  return "(χ²/dof " + fixed_or_power(fit.chi2_per_dof, 2) + ", R² " + fixed(fit.r_squared, 3) +
         ", " + std::to_string(fit.widths) + " widths)";
}

/// One fit: the symbols, bulk value beside the periodic one, slope, and how good the line is.
std::string fit_text(const Family& family, Quantity quantity, int decimals,
                     const GivenUnits& units) {
  const bool is_phi = quantity == Quantity::solid_fraction;
  const std::string symbol = is_phi ? "φ" : "Z", slope = is_phi ? "C" : "C_Z";
  const std::string extent = first_group(family).job.box.is_tube ? "/D:  " : "/W:  ";
  const std::string law = "  " + symbol + " = " + symbol + "_bulk - " + slope + extent;
  const WallFit fit = fit_walls(family, quantity);
  if (!fit.not_determined.empty()) {
    return law + "not determined:\n      " + fit.not_determined + "\n";
  }
  std::string text =
      law + symbol + "_bulk = " + with_error(fit.bulk.value, fit.bulk.error, decimals) +
      protocol_text(fit, decimals) + reference_text(family, quantity, decimals) + "\n" + "      " +
      slope + " = " + length_text(fit.slope.value, fit.slope.error, decimals - 1, units) +
      ",  ζ = " + slope + "/" + symbol +
      "_bulk = " + length_text(fit.zeta.value, fit.zeta.error, 3, units) +
      (units ? "\n      " : "  ") + quality_text(fit) + "\n";
  if (fit.narrow_widths > 0) text += "      " + left_out_text(fit) + "\n";
  for (std::size_t at = 0; at < fit.doubt.size();) {  // each on its own line
    const std::size_t end = std::min(fit.doubt.find("; ", at), fit.doubt.size());
    text += "      " + fit.doubt.substr(at, end - at) + "\n";
    at = end + 2;
  }
  return text;
}

/// " (periodic: open)": labels of packings without walls that those between walls, by which
/// families are called, do not have.
std::string other_labels(const std::vector<const Family*>& families) {
  std::set<std::string> walled, told;
  for (const Family* family : families) {
    for (const Group& group : family->walled) walled.insert(group.job.label);
  }
  std::string text;
  if (walled.empty()) return text;
  for (const Family* family : families) {
    for (const Group& group : family->periodic) {
      const std::string& label = group.job.label;
      if (label.empty() || walled.contains(label) || !told.insert(label).second) continue;
      text += (text.empty() ? " (periodic: " : " + ") + label;
    }
  }
  return text + (text.empty() ? "" : ")");
}

/// A family with its fits.
std::string family_text(const Family& family, const GivenUnits& units) {
  std::vector<TableLine> lines;
  append_lines(family, lines);
  for (TableLine& line : lines) line.name.clear();
  return "\n" + family.name + other_labels({&family}) + "\n" + table_text(lines) +
         fit_text(family, Quantity::solid_fraction, solid_fraction_decimals, units) +
         fit_text(family, Quantity::coordination, coordination_decimals, units);
}

/// Families of the same labels, all with too few widths to show what walls do.
std::string families_text(const std::vector<const Family*>& families) {
  std::vector<TableLine> lines;
  bool is_walled = false;
  std::set<double> lengths;
  for (const Family* family : families) {
    append_lines(*family, lines);
    is_walled = is_walled || !family->walled.empty();
    if (!first_group(*family).job.box.is_tube) lengths.insert(first_group(*family).job.box.length);
  }
  std::string text =
      "\n" + families.front()->labels + other_labels(families) + "\n" + table_text(lines);
  if (is_walled) {
    const std::string extent = extent_in(lines);
    text += "  φ = φ_bulk - C/" + extent + " and Z = Z_bulk - C_Z/" + extent +
            ":  not determined: needs packings at 3 or more\n"
            "      widths with otherwise equal parameters" +
            (lengths.size() > 1 ? "; here box.length differs, too" : "") + "\n";
  }
  return text;
}

std::string tables_text(const std::vector<Family>& families, const GivenUnits& units) {
  constexpr std::size_t fewest_widths = 3;
  std::map<std::string, std::vector<const Family*>> narrow;  // by labels
  for (const Family& family : families) {
    if (family.walled.size() < fewest_widths) narrow[family.labels].push_back(&family);
  }
  std::string text;
  for (const Family& family : families) {
    if (family.walled.size() >= fewest_widths) {
      text += family_text(family, units);
    } else if (narrow[family.labels].front() == &family) {
      text += families_text(narrow[family.labels]);
    }
  }
  return text;
}

/// All groups again, in the units of the sweep; nothing without any.
std::string laboratory_text(const std::vector<Family>& families, const GivenUnits& units) {
  if (!units) return "";
  std::vector<TableLine> lines;
  for (const Family& family : families) append_lines(family, lines);
  std::size_t line = 0;
  for (const Family& family : families) {
    const std::size_t end = line + family.walled.size() + family.periodic.size();
    for (; line < end; ++line) lines[line].name = families.size() > 1 ? family.name : "";
  }
  return "\n" + units_text(*units) + "\n" + table_text(lines, laboratory_columns(lines, *units));
}

/// Distinct values of a definition over the sweep: "3", or "2 or 3".
template <class Value>
std::string distinct(const std::vector<Row>& rows, Value value) {
  std::set<double> values;
  for (const Row& row : rows) values.insert(value(row.job.measure));
  std::string text;
  for (const double one : values) text += (text.empty() ? "" : " or ") + cell(one);
  return text;
}

constexpr std::string_view file_keys[] = {"\"file\":", "\"files\":"};

constexpr const char *of_one_size = "the mean diameter of the grains",
                     *of_large_grains = "the mean diameter of the large grains";

/// What d is in a packing: a length of the user's choice where sizes are a distribution or come
/// from a file.
std::string unit_of(const JobFacts& job) {
  const std::string& parameters = job.parameters.text();
  const bool has_own_unit =
      has_size_distribution(job) ||
      std::any_of(std::begin(file_keys), std::end(file_keys),
                  [&](std::string_view key) { return parameters.find(key) != std::string::npos; });
  if (has_own_unit) return "the length chosen as 1 for sizes";
  if (job.shape == "hull") return "the length of a hull that is its \"size\"";
  if (job.shape != "sphere") return "the unit in which shapes are written";
  return job.small_share == 0.0 ? of_one_size : of_large_grains;
}

/// What d is in the packings of a sweep, which may differ in it.
std::string unit_meaning(const std::vector<Row>& rows) {
  std::set<std::string> meanings;
  for (const Row& row : rows) meanings.insert(unit_of(row.job));
  if (meanings.contains(of_large_grains)) meanings.erase(of_one_size);  // they are all large
  std::string text;
  for (const std::string& meaning : meanings) text += (text.empty() ? ", " : ", or ") + meaning;
  return text;
}

std::string definitions_text(const std::vector<Row>& rows) {
  const auto gap = [](const MeasureSpec& measure) {
    return measure.gap_tolerances.empty() ? 0.0 : measure.gap_tolerances.front();
  };
  const bool has_tubes =
      std::any_of(rows.begin(), rows.end(), [](const Row& row) { return row.job.box.is_tube; });
  constexpr std::size_t line_width = 100;  // characters
  const std::string text =
      "Lengths in d" + unit_meaning(rows) + ". φ: exact solid volume between " +
      distinct(rows, [](const MeasureSpec& m) { return m.exclude_floor; }) +
      " d above the floor and " +
      distinct(rows, [](const MeasureSpec& m) { return m.exclude_surface; }) +
      " d below the surface. Z: neighbours per grain there with gap < " + distinct(rows, gap) +
      " d, walls not counted. ±: standard error, wider where few packings tell it; what single "
      "packings scatter by is in groups.csv. contacts/iso: force-bearing contacts over the "
      "isostatic count, 1 at perfect rest." +
      (has_tubes ? " In narrow tubes it is less, as a round wall holds grains along it, too, or "
                   "more, where equal grains order."
                 : "");
  return "\n" + filled_lines(text, line_width) + "\nOnly settled packings enter means and fits.\n";
}

/// How far the means lie at most from those of beds settled ever better.
std::string bias_text(const std::vector<Family>& families) {
  std::set<std::string> bounds;
  const auto note = [&](const Group& group) {
    const auto& bound = group.bias_bound;
    const auto of_z = [&] {
      return std::isnan(bound->coordination)
                 ? " (φ); of Z at that gap it was not measured"
                 : " (φ) and " + fixed(bound->coordination, coordination_decimals) + " (Z)";
    };
    bounds.insert(bound ? fixed(bound->solid_fraction, solid_fraction_decimals) + of_z() : "");
  };
  for (const Family& family : families) {
    for (const Group& group : family.walled) note(group);
    for (const Group& group : family.periodic) note(group);
  }
  if (bounds.size() > 1) return "Bounds of what the protocol does to means: groups.csv.\n";
  if (bounds.empty() || bounds.begin()->empty()) {
    return "What the protocol does to the means of such packings was not measured.\n";
  }
  return "Protocol: means of beds settled ever better lie within " + *bounds.begin() + ".\n";
}

/// "  walls, W = 5: 0.050": a line for each group about which `tell` has something to say, only the
/// first few.
template <class Tell>
std::string lines_of_groups(const std::vector<Family>& families, Tell tell) {
  constexpr int groups_shown = 5;
  std::string text;
  int count = 0;
  const auto add = [&](const Group& group) {
    const std::string told = tell(group);
    if (told.empty() || ++count > groups_shown) return;
    text += "  " + group.family_name + (group.job.box.is_tube ? ", D = " : ", W = ") +
            width_text(cell(group.job.box.width), group.job.box.y) + ": " + told + "\n";
  };
  for (const Family& family : families) {
    for (const Group& group : family.walled) add(group);
    for (const Group& group : family.periodic) add(group);
  }
  if (count > groups_shown) {
    text += "  and " + std::to_string(count - groups_shown) + " more, see groups.csv\n";
  }
  return text;
}

/// Whether a share of small grains is a tenth more or less than another.
bool differs(double share, double from) { return std::abs(share - from) > 0.1 * from; }

/// Groups whose beds have another share of small grains than was requested, for example none where
/// a whole grain is more than the share.
std::string small_share_text(const std::vector<Family>& families) {
  const std::string text = lines_of_groups(families, [](const Group& group) -> std::string {
    const double all = mean_of(group, "bed_small_share").mean, asked = group.job.small_share;
    return asked > 0.0 && differs(all, asked)
               ? fixed(all, 4) + " of the solid volume, asked for " + cell(asked)
               : "";
  });
  return text.empty() ? ""
                      : "\nWarning: beds hold another share of small grains, told apart by size, "
                        "than was asked for. More\ngrains come nearer to a small share; sizes "
                        "that nearly agree cannot be told apart:\n" +
                            text;
}

/// "0.071 by volume up to 0.2 d, in the whole bed 0.100": where the slab of grains of a
/// distribution differs most from the bed; nothing where it does not, or its curves cannot be read.
std::string sizes_in_slab_text(const Group& group, const std::string& folder) {
  if (group.settled.empty() || !has_size_distribution(group.job)) return "";
  try {
    const GroupWithCurves with_curves(group, folder);
    const auto line = slab_difference(*with_curves);
    return line ? fixed(line->slab.mean, 3) + " by " + size_weight(group.job) + " up to " +
                      number_text(line->diameter) + " d, in the whole bed " +
                      fixed(line->packed.mean, 3) + " (sizes.csv)"
                : "";
  } catch (const FileError&) {
    return "";  // whoever reads results is warned about damaged beds
  }
}

/// Groups whose measured slab holds a tenth more or less of small grains than their beds: small
/// grains that fit through the gaps between large ones sink to the floor.
std::string percolation_text(const std::vector<Family>& families, const std::string& folder) {
  const std::string text = lines_of_groups(families, [&](const Group& group) -> std::string {
    std::string by_sizes = sizes_in_slab_text(group, folder);
    if (!by_sizes.empty()) return by_sizes;
    const double all = mean_of(group, "bed_small_share").mean;
    const double slab = mean_of(group, "slab_small_share").mean;
    return differs(slab, all)
               ? fixed(slab, 3) + " of the solid volume, in the whole bed " + fixed(all, 3)
               : "";
  });
  return text.empty() ? ""
                      : "\nWarning: small grains are not where they were asked for; φ and Z are of "
                        "the slab, which holds\n" +
                            text;
}

std::string left_out_text(const StatusCounts& counts) {
  std::string text;
  const auto add = [&](int count, const char* what) {
    if (count > 0) text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + what;
  };
  add(counts.not_settled, "did not settle");
  add(counts.failed, "failed");
  add(counts.pending, "not made yet");
  return text;
}

std::string headline(const std::string& name, std::size_t packings, const StatusCounts& counts) {
  const std::string left_out = left_out_text(counts);
  std::string text = name + ": " + counted(packings, "packing") + ", " +
                     std::to_string(counts.settled) + " settled";
  if (!left_out.empty()) text += "; left out of means and fits: " + left_out;
  return text + "\n";
}

/// The first few packings that failed or did not settle, and why.
std::string reasons_text(const std::vector<Row>& rows, const PackingNames& names) {
  constexpr int reasons_shown = 5;
  std::string text;
  int count = 0;
  for (const Row& row : rows) {
    if (!row.outcome || is_settled(row) || ++count > reasons_shown) continue;
    text += "  " + row.job.id + " (" + names.set_of(row.job) + "): " + status_words(row) +
            "\n      " + row.outcome->result.reason + "\n";
  }
  if (count > reasons_shown) {
    text += "  and " + std::to_string(count - reasons_shown) + " more, see packings.csv\n";
  }
  return text.empty() ? "" : "\nNot in the means:\n" + text;
}

std::string effort_text(const Provenance& provenance, double cpu_seconds) {
  std::string text = "\nCPU time of all packings " + duration_text(cpu_seconds);
  if (!provenance.runs.empty()) {
    const RunRecord& last = provenance.runs.back();
    const auto of = [](int count, const char* noun) {
      return counted(static_cast<std::size_t>(count), noun);
    };
    text += last.ended.empty() ? "; the last run has not ended"
                               : "; last run " + duration_text(last.wall_seconds) + " for " +
                                     of(last.packings, "packing") + " on " +
                                     of(last.threads, "thread") + ", " + last.isa;
  }
  return text + "\n";
}

/// Where the tables are.
std::string where_text(const std::vector<Family>& families, const ReportPlace& place) {
  if (!place.has_tables) return "";
  const auto has_sizes = [](const Group& group) { return has_size_distribution(group.job); };
  const bool have_sizes = std::any_of(families.begin(), families.end(), [&](const Family& family) {
    return std::any_of(family.walled.begin(), family.walled.end(), has_sizes) ||
           std::any_of(family.periodic.begin(), family.periodic.end(), has_sizes);
  });
  return (place.is_worked_on ? "Tables come when the run ends, in " : "Tables in ") + place.folder +
         ": packings.csv, groups.csv, fits.csv, profiles.csv, decays.csv" +
         (have_sizes ? ", sizes.csv" : "") +
         " and more;\n"
         "provenance.json says how they were made\n";
}

std::string next_text(const std::string& sweep_file, const StatusCounts& counts,
                      const ReportPlace& place) {
  const std::string folder = shell_path(place.folder);
  const std::string file = sweep_file.empty() ? "FILE" : shell_path(sweep_file);
  if (counts.pending > 0 && place.is_worked_on) {
    return "A runner makes what is missing: " + place.program + " status " + folder +
           " tells how far it is\n";
  }
  if (counts.pending > 0) {
    return "Next: " + place.program + " run " + file + " --out " + folder +
           " makes what is missing\n";
  }
  if (!place.has_grains) return "";
  return "Next: " + place.program + " export " + folder +
         " --format vtp writes the grains for ParaView\n";
}

}  // namespace

bool has_grains(const std::string& folder, const std::vector<Row>& rows) {
  for (const Row& row : rows) {
    if (!row.outcome || row.outcome->stored_bytes == 0) continue;
    try {
      return !read_bed(folder, *row.outcome).grains.empty();
    } catch (const FileError&) {
      continue;  // whoever reads results is warned about damaged beds
    }
  }
  return false;
}

std::string closing_report(const Provenance& provenance, const std::vector<Row>& rows,
                           const std::vector<Family>& families, const ReportPlace& place) {
  const Totals totals = totals_of(rows);
  std::string text = headline(provenance.sweep_name, rows.size(), totals.counts);
  return text + tables_text(families, provenance.units) +
         laboratory_text(families, provenance.units) + definitions_text(rows) +
         bias_text(families) + small_share_text(families) +
         percolation_text(families, place.folder) + reasons_text(rows, PackingNames(families)) +
         effort_text(provenance, totals.cpu_seconds) + where_text(families, place) +
         next_text(sweep_file_of(provenance), totals.counts, place);
}

}  // namespace grainsweep
