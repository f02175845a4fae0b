// The command `export`: the beds of stored packings, a file each.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include <CLI/App.hpp>
#include <nlohmann/json.hpp>

#include "runner/commands/commands.hpp"
#include "runner/commands/inputs.hpp"
#include "runner/commands/shared_options.hpp"
#include "runner/exit_codes.hpp"
#include "runner/export/file_names.hpp"
#include "runner/export/formats.hpp"
#include "runner/jobs/progress.hpp"
#include "runner/report/bed_view.hpp"
#include "runner/store/files.hpp"
#include "runner/tables/csv.hpp"
#include "runner/tables/units.hpp"
#include "runner/text.hpp"

namespace grainsweep {
namespace {

/// The format that is no file for other programs but a page.
constexpr const char* page_format = "html";

std::vector<std::string> format_names() {
  std::vector<std::string> names;
  for (const ExportFormat& format : export_formats()) names.emplace_back(format.name);
  names.emplace_back(page_format);
  return names;
}

/// "csv, xyz, ...", and beneath them "or html".
std::string formats_text() {
  std::string text;
  for (const ExportFormat& format : export_formats()) {
    text += (text.empty() ? "" : ", ") + std::string(format.name);
  }
  return text + "\nor " + page_format;
}

std::vector<std::string> endings() {
  std::vector<std::string> all = {std::string(".") + page_format};
  for (const ExportFormat& format : export_formats()) all.emplace_back(format.ending);
  return all;
}

bool has_bed(const Row& row) { return row.outcome && row.outcome->stored_bytes > 0; }

/// The numbers of the rows to export: those asked for, or all that have beds. Throws BadInput.
std::vector<std::size_t> rows_to_export(const std::vector<Row>& rows,
                                        const ExportOptions& options) {
  std::vector<std::size_t> chosen;
  std::vector<std::string> ids;
  ids.reserve(rows.size());
  for (const Row& row : rows) ids.push_back(row.job.id);
  for (const std::string& job : options.jobs) {
    const std::size_t k = place_of_job(job, ids, options.folder + "/packings.csv");
    if (!has_bed(rows[k]))
      throw BadInput("--job " + job + ": has no grains, it is " + status_words(rows[k]));
    chosen.push_back(k);
  }
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (options.jobs.empty() && has_bed(rows[k])) chosen.push_back(k);
  }
  return chosen;
}

std::string page_of(const StoredBed& bed, const Row& row, const GivenUnits& units) {
  BedFacts facts = facts_of(row.job, row.job.label + ", packing " + row.job.id);
  facts.units = units;
  return bed_page(bed, facts);
}

/// Its canonical parameters that say what its grains are.
std::string shape_of(const JobFacts& job) {
  return nlohmann::json::parse(job.parameters.text()).at("shape").dump();
}

/// Why the format cannot hold the grains of a packing; "" if it can, or if its bed cannot be read,
/// which is reported when it is to be written.
std::string fault_of(const ExportFormat& format, const std::string& folder, const Row& row) {
  try {
    return format.fault(read_bed(folder, *row.outcome));
  } catch (const FileError&) {
    return "";
  }
}

/// Looks at the first bed of each shape, before anything is written. Throws BadInput if the format
/// can hold none of them; otherwise those that it cannot hold are left out.
void refuse_shapes_without_room(const ExportFormat* format, const std::string& folder,
                                const std::vector<Row>& rows,
                                const std::vector<std::size_t>& chosen) {
  if (format == nullptr || format->fault == nullptr) return;
  std::set<std::string> seen;
  std::string first_fault;
  for (const std::size_t k : chosen) {
    const JobFacts& job = rows[k].job;
    if (!seen.insert(shape_of(job)).second) continue;
    const std::string fault = fault_of(*format, folder, rows[k]);
    if (fault.empty()) return;
    if (first_fault.empty()) {
      first_fault = "packing " + job.id + ", shape " + job.shape + ": " + fault;
    }
  }
  if (first_fault.empty()) return;
  throw BadInput("--format " + std::string(format->name) + ": " + first_fault);
}

/// Refuses options that other formats would silently ignore. Throws BadInput.
void refuse_what_does_not_apply(const ExportOptions& options) {
  const auto expect = [&](bool is_given, const char* option, bool applies, const char* formats) {
    if (is_given && !applies) {
      throw BadInput(std::string(option) + " is of --format " + formats + ", not of " +
                     options.format);
    }
  };
  const ExportOptions usual;
  const bool has_surfaces = options.format == "stl" || options.format == "obj";
  expect(options.contacts != usual.contacts, "--contacts", has_surfaces, "stl and obj");
  expect(options.periodic_images, "--periodic-images", has_surfaces, "stl and obj");
  const std::set<std::string> with_units = {"csv", "xyz", "vtp", "stl", "obj", "voxels"};
  expect(options.in_units, "--in-units", with_units.contains(options.format),
         "csv, xyz, vtp, stl, obj and voxels");
  expect(options.voxels != usual.voxels, "--voxels", options.format == "voxels", "voxels");
}

/// Throws BadInput.
ExportSettings settings_of(const ExportOptions& options, const GivenUnits& units) {
  ExportSettings settings{{}, options.periodic_images, options.voxels};
  if (options.in_units && !units) {
    throw BadInput(
        "--in-units: the sweep has no units; give it \"units\": {\"d\": 3.2, \"unit\": "
        "\"mm\"} and run it again, which makes no packing anew");
  }
  if (options.in_units) settings.lengths = *units;
  if (options.contacts == "touch") return settings;
  const auto treatment = contact_treatment(options.contacts);
  if (!treatment) {
    throw BadInput(
        "--contacts " + options.contacts +
        ": use touch, shrink:SHARE, cap:SHARE or bridge:SHARE with a share between 0 and 1, of "
        "cap and bridge at least " +
        cell(least_cut));
  }
  settings.treatment = *treatment;
  return settings;
}

ExportedBed exported(StoredBed&& bed, const JobFacts& job, const ExportSettings& settings) {
  const auto& tolerances = job.measure.gap_tolerances;
  return {std::move(bed), small_class_limit(job),
          *std::max_element(tolerances.begin(), tolerances.end()), settings};
}

/// How and where to beds are written.
struct Writing {
  const ExportFormat* format = nullptr;  ///< null: a page
  ExportSettings settings;
  GivenUnits units;
  std::string from, to;  ///< folders
  std::string contacts;  ///< as it was asked for
};

/// What became of them.
struct Written {
  std::map<std::string, std::string> jobs;  ///< by their files
  std::size_t unsettled = 0;
  std::vector<BedFault> faults;
  std::vector<std::string> refused;  ///< why beds are left out that can be read
};

std::string text_of(const Writing& writing, StoredBed&& bed, const Row& row) {
  return writing.format != nullptr
             ? writing.format->text(exported(std::move(bed), row.job, writing.settings))
             : page_of(bed, row, writing.units);
}

/// Writes the bed of a packing, if it has one that fits; returns what came of it, for a line.
std::string write_bed(const Writing& writing, const Row& row, const std::string& file,
                      Written& written) {
  StoredBed bed;
  try {
    bed = read_bed(writing.from, *row.outcome);
  } catch (const FileError& error) {
    written.faults.push_back(fault_of_bed(row.job.id, error));
    return std::string("left out: ") + error.what();
  }
  try {
    const std::size_t grains = bed.grains.size();
    const std::string text = text_of(writing, std::move(bed), row);
    replace_file(writing.to + "/" + file, text, Flush::later);
    written.jobs[file] = row.job.id;
    written.unsettled += is_settled(row) ? 0 : 1;
    return counted(grains, "grain") + ", " + size_text(text.size());
  } catch (const BadInput& error) {  // this bed cannot have the format; others may
    return "left out: " + written.refused.emplace_back(error.what());
  } catch (const std::logic_error& error) {  // a surface that could not be cut or joined
    return "left out: " + written.refused.emplace_back("packing " + row.job.id + ": --contacts " +
                                                       writing.contacts +
                                                       " leaves a surface that cannot be closed (" +
                                                       error.what() + "); take a larger share");
  }
}

/// What was not written, or is not at rest.
void tell_what_lacks(const Written& written, std::size_t without_grains,
                     const std::string& remedy) {
  if (written.unsettled > 0) {
    std::cout << written.unsettled
              << " of them did not settle or failed: see the column status there\n";
  }
  if (!written.refused.empty()) {
    std::cout << counted(written.refused.size(), "packing")
              << " left out: " << written.refused.front()
              << (written.refused.size() > 1 ? ", and others" : "") << "\n";
  }
  if (without_grains > 0) {
    std::cout << counted(without_grains, "packing") << " left out: stored without grains; "
              << remedy << "\n";
  }
}

}  // namespace

void add_command(CLI::App& app, ExportOptions& options) {
  CLI::App& grains = *app.add_subcommand("export", "Write the beds of finished packings");
  add_folder(grains, options.folder);
  grains.add_option("--format", options.format, formats_text())
      ->transform(CLI::IsMember(format_names(), CLI::ignore_case))
      ->capture_default_str()
      ->type_name("NAME");
  add_jobs(grains, options.jobs, "only these packings: ids in packings.csv, or how they begin");
  grains
      .add_option("--contacts", options.contacts,
                  "of stl and obj: touch, shrink:SHARE (of all lengths),\n"
                  "cap:SHARE (cut off, of so many radii) or\n"
                  "bridge:SHARE (joined by necks of so many);\n"
                  "SHARE below 1, of cap and bridge from 0.001")
      ->capture_default_str()
      ->type_name("HOW");
  grains.add_flag("--periodic-images", options.periodic_images,
                  "of stl and obj: also what comes in through periodic sides");
  grains.add_flag("--in-units", options.in_units,
                  "of csv, xyz, vtp, stl, obj and voxels: lengths in the unit of\n"
                  "the sweep, not in d");
  grains.add_option("--voxels", options.voxels, "of voxels: so many a d")
      ->check(number_within(1.0, 1000.0))
      ->capture_default_str()
      ->type_name("N");
  grains.add_flag("--quiet", options.quiet, "show no progress");
  grains.add_option("--to", options.to, "folder for the files (default: DIR/export)")
      ->check(not_empty())
      ->type_name("DIR");
  grains.footer("Example: grainsweep export out/quick --format vtp --to /tmp/beds");
}

int perform(const ExportOptions& options) {
  const ExportFormat* format = export_format(options.format);  // null: a page
  const std::string ending =
      format != nullptr ? std::string(format->ending) : std::string(".") + page_format;
  refuse_what_does_not_apply(options);
  const Results results = results_with_warnings(options.folder);
  const ExportSettings settings = settings_of(options, results.provenance.units);
  const std::vector<Row>& rows = results.rows;
  std::vector<std::size_t> chosen = rows_to_export(rows, options);
  const std::string to = options.to.empty() ? options.folder + "/export" : options.to;
  if (chosen.empty()) throw BadInput(options.folder + ": holds no finished packing to export");
  const std::size_t without_grains =
      std::erase_if(chosen, [&](std::size_t k) { return lacks_grains(*rows[k].outcome); });
  const std::string remedy = grains_remedy(sweep_file_of(results.provenance), options.folder);
  if (chosen.empty()) {
    throw BadInput(options.folder + ": " + counted(without_grains, "packing") +
                   " to export, stored without grains; " + remedy);
  }
  const auto is_periodic = [&](std::size_t k) {
    return std::isfinite(shortest_period(rows[k].job.box));
  };
  if (options.periodic_images && std::none_of(chosen.begin(), chosen.end(), is_periodic)) {
    throw BadInput("--periodic-images: no packing has a periodic side");
  }
  refuse_shapes_without_room(format, options.folder, rows, chosen);
  make_folder(to);
  remove_leftovers_of_ended(to);
  const std::vector<std::string> stems = file_stems(rows);
  std::map<std::string, std::string> taken;
  for (const std::size_t k : chosen) taken[stems[k] + ending] = rows[k].job.id;
  const auto index = index_without(to, taken);
  if (index) replace_file(to + "/index.csv", *index);
  const Writing writing{format,         settings, results.provenance.units,
                        options.folder, to,       options.contacts};
  Written written;
  ProgressDisplay display(std::vector<double>(chosen.size(), 1.0),
                          options.quiet ? ProgressStyle::quiet : progress_style(), stderr);
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    const std::string file = stems[chosen[i]] + ending;
    display.start();
    display.finish(i, true, file + "  " + write_bed(writing, rows[chosen[i]], file, written));
  }
  display.clear();
  std::cerr << damage_warnings(lines_of(written.faults, "left out"));
  if (written.jobs.empty() && !written.faults.empty()) return exit_file_system;
  if (written.jobs.empty() && !written.refused.empty()) throw BadInput(written.refused.front());
  const std::vector<std::string> old = superseded(to, written.jobs);
  const std::string unit = format != nullptr ? settings.lengths.unit : "";  // a page names its own
  replace_file(to + "/index.csv", index_csv(to, rows, endings(), written.jobs, unit));
  for (const std::string& file : old) remove_file(to + "/" + file);
  if (!old.empty()) {
    std::cerr << "note: " << counted(old.size(), "file")
              << " of an earlier export removed, as the same packings have other names now: "
              << old.front() << (old.size() > 1 ? ", ..." : "") << "\n";
  }
  if (index) {
    std::cerr << "note: files of an earlier export were replaced by those of other packings, whose "
                 "groups have their numbers now: see index.csv\n";
  }
  std::cout << counted(written.jobs.size(), "packing") << " written to " << to
            << "/<label>-<group>-<replicate>" << ending << ", listed in index.csv\n";
  if (const GivenUnits& units = results.provenance.units; units && format != nullptr) {
    const std::string d = "d, which is " + length_in(*units, 1.0) + " ";
    std::cout << "Lengths in them are in " << (options.in_units ? "" : d) << printed_unit(*units)
              << "\n";
  }
  tell_what_lacks(written, without_grains, remedy);
  if (!written.faults.empty()) return exit_file_system;
  return written.refused.empty() || options.jobs.empty() ? exit_done : exit_bad_input;
}

}  // namespace grainsweep
