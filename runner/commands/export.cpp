// The command `export`: the grains of stored packings, a file each.
#include <algorithm>
#include <iostream>

#include <CLI/App.hpp>

#include "runner/commands/commands.hpp"
#include "runner/commands/inputs.hpp"
#include "runner/commands/shared_options.hpp"
#include "runner/exit_codes.hpp"
#include "runner/report/bed_view.hpp"
#include "runner/store/files.hpp"
#include "runner/store/states.hpp"
#include "runner/tables/grain_files.hpp"
#include "runner/text.hpp"

namespace grainsweep {
namespace {

/// The format that is no file of grains but a page.
constexpr const char* page_format = "html";

bool has_grains(const Row& row) { return row.outcome && row.outcome->stored_bytes > 0; }

/// The rows to export: those asked for, or all that have grains. Throws BadInput.
std::vector<const Row*> rows_to_export(const std::vector<Row>& rows, const ExportOptions& options) {
  std::vector<const Row*> chosen;
  for (const std::string& job : options.jobs) {
    const auto found =
        std::find_if(rows.begin(), rows.end(), [&](const Row& row) { return row.job.id == job; });
    if (found == rows.end()) {
      throw BadInput("--job " + job + ": no such packing; see the column job in " + options.folder +
                     "/packings.csv");
    }
    if (!has_grains(*found))
      throw BadInput("--job " + job + ": has no grains, it is " + status_of(*found));
    chosen.push_back(&*found);
  }
  for (const Row& row : rows) {
    if (options.jobs.empty() && has_grains(row)) chosen.push_back(&row);
  }
  return chosen;
}

std::string page_of(const StoredBed& bed, const Row& row, const GivenUnits& units) {
  BedFacts facts = facts_of(row.job, row.job.label + ", packing " + row.job.id);
  facts.units = units;
  return bed_page(bed, facts);
}

}  // namespace

CLI::App& add_command(CLI::App& app, ExportOptions& options) {
  CLI::App& grains = *app.add_subcommand("export", "Write the grains of finished packings");
  add_folder(grains, options.folder);
  grains
      .add_option("--format", options.format,
                  "csv, xyz (for OVITO), vtp (for ParaView), or html: a bed that turns")
      ->check(CLI::IsMember({"csv", "xyz", "vtp", "html"}))
      ->capture_default_str()
      ->type_name("NAME");
  grains
      .add_option("--job", options.jobs,
                  "only this packing: its id in packings.csv; may be repeated")
      ->type_name("ID")
      ->allow_extra_args(false);
  grains.add_option("--to", options.to, "folder for the files (default: DIR/export)")
      ->type_name("DIR");
  grains.footer("Example: grainsweep export out/quick --format vtp --to /tmp/beds");
  return grains;
}

int perform(const ExportOptions& options) {
  const auto format = export_format(options.format);
  if (!format && options.format != page_format) {
    throw BadInput("--format " + options.format + ": use csv, xyz, vtp or html");
  }
  const Results results = results_with_warnings(options.folder);
  const std::vector<const Row*> rows = rows_to_export(results.rows, options);
  const std::string to = options.to.empty() ? options.folder + "/export" : options.to;
  if (rows.empty()) throw BadInput(options.folder + ": holds no finished packing to export");
  make_folder(to);
  std::size_t written = 0;
  for (const Row* row : rows) {
    const StoredBed bed = read_bed(options.folder, *row->outcome);
    if (bed.grains.empty()) continue;  // of a run with --no-grains
    ++written;
    const std::string text =
        format ? grains_text(bed, *format) : page_of(bed, *row, results.provenance.units);
    replace_file(to + "/" + row->job.id + "." + options.format, text);
  }
  if (written == 0) throw BadInput(options.folder + ": its packings were stored without grains");
  std::cout << counted(written, "packing") << " written to " << to << "/<job>." << options.format
            << "\n";
  return exit_done;
}

}  // namespace grainsweep
