#include "runner/commands/command_line.hpp"

#include <string>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "engine/dynamics/presets.hpp"
#include "runner/exit_codes.hpp"
#include "runner/versions.hpp"

namespace grainsweep {
namespace {

constexpr const char* exit_codes_text =
    "Exit codes: 0 done; 1 done, but some packings failed or did not settle; 2 bad input, nothing\n"
    "written; 3 another runner works in the folder; 4 file system; 130 or 143 stopped by Ctrl-C "
    "or\n"
    "SIGTERM: the same command goes on where it stopped.";

/// Options of all commands while the command line is read.
struct AllOptions {
  RunOptions run;
  ValidateOptions validate;
  PlanOptions plan;
  ReportOptions report;
  CompareOptions compare;
  ExportOptions grains;
  StatusOptions status;
  CollectOptions collect;
  SchemaOptions schema;
  ColumnsOptions columns;
  DoctorOptions doctor;
};

std::string presets_text() {
  std::string text = "Accuracy, a member of the sweep file:";
  for (const Preset& preset : presets()) {
    text += "\n  " + std::string(preset.name) + ": " + std::string(preset.promise);
  }
  return text;
}

void add_threads(CLI::App& command, int& threads) {
  command.add_option("--threads", threads, "packings at once (default: one per core)")
      ->check(CLI::Range(1, 1024))
      ->type_name("N");
}

void add_file(CLI::App& command, std::string& file) {
  command.add_option("FILE", file, "sweep definition, JSON")->required()->type_name("");
}

void add_folder(CLI::App& command, std::string& folder) {
  command.add_option("DIR", folder, "output folder of a run")->required()->type_name("");
}

void add_run(CLI::App& app, RunOptions& options) {
  CLI::App& run = *app.add_subcommand(
      "run", "Make the packings of a sweep, or what is missing of them, and the tables");
  add_file(run, options.file);
  run.add_option("--out", options.out, "output folder (default: out/<sweep name>)")
      ->type_name("DIR");
  add_threads(run, options.threads);
  run.add_option("--isa", options.isa,
                 "sse2, avx2 or avx512 (default: GRAINSWEEP_ISA, else the widest)")
      ->type_name("NAME");
  run.add_option("--checkpoint-seconds", options.checkpoint_seconds,
                 "save packings under way this often; stopping always saves them")
      ->check(CLI::Range(0.0, 86400.0))
      ->capture_default_str()
      ->type_name("S");
  run.add_flag("--fresh", options.fresh, "delete what is stored in the folder and start anew");
  run.add_flag("--yes", options.yes, "do not ask before --fresh deletes");
  run.add_flag("--retry-failed", options.retry_failed,
               "make failed packings again, for instance with a newer version");
  run.add_flag("--fail-fast", options.fail_fast,
               "stop at the first packing that fails; without it the others go on");
  run.add_flag("--quiet", options.quiet, "print warnings and errors only");
  run.footer("Example: grainsweep run configs/quick.json --out out/quick --threads 2\n\n" +
             presets_text() + "\n\n" + exit_codes_text);
}

void add_validate(CLI::App& app, ValidateOptions& options) {
  CLI::App& validate =
      *app.add_subcommand("validate", "Check a sweep file and say everything wrong with it");
  add_file(validate, options.file);
  validate.footer("Example: grainsweep validate configs/quick.json");
}

void add_plan(CLI::App& app, PlanOptions& options) {
  CLI::App& plan =
      *app.add_subcommand("plan", "List the packings of a sweep with estimated time and memory");
  add_file(plan, options.file);
  add_threads(plan, options.threads);
  plan.add_flag("--json", options.json, "every packing, as JSON");
  plan.footer("Example: grainsweep plan configs/confined-spheres.json --threads 8");
}

void add_report(CLI::App& app, ReportOptions& options) {
  CLI::App& report = *app.add_subcommand("report", "Print the closing table of a run again");
  add_folder(report, options.folder);
  report.footer("Example: grainsweep report out/quick");
}

void add_compare(CLI::App& app, CompareOptions& options) {
  CLI::App& compare = *app.add_subcommand(
      "compare", "Print results beside published values, and whether they agree");
  add_folder(compare, options.folder);
  compare
      .add_option("--with", options.with,
                  "published values, JSON (default: SWEEP.reference.json beside SWEEP.json)")
      ->type_name("FILE");
  compare.footer(
      "Each row says what was measured and how, by how much it differs from the published value,\n"
      "and how many standard errors that is; \"not determined\" and why where the sweep does not\n"
      "tell.\n\nExample: grainsweep compare out/paper-spheres\n"
      "Example: grainsweep compare out/quick --with configs/paper-spheres.reference.json");
}

void add_export(CLI::App& app, ExportOptions& options) {
  CLI::App& grains = *app.add_subcommand("export", "Write the grains of finished packings");
  add_folder(grains, options.folder);
  grains
      .add_option("--format", options.format,
                  "csv, xyz (extended XYZ, for OVITO) or vtp (for ParaView)")
      ->check(CLI::IsMember({"csv", "xyz", "vtp"}))
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
}

void add_status(CLI::App& app, StatusOptions& options) {
  CLI::App& status =
      *app.add_subcommand("status", "Say how much of a sweep is done and who is at work");
  add_folder(status, options.folder);
  status.add_flag("--json", options.json, "as JSON");
  status.footer("Example: grainsweep status out/quick");
}

void add_collect(CLI::App& app, CollectOptions& options) {
  CLI::App& collect =
      *app.add_subcommand("collect", "Merge the results of several output folders into one");
  collect.add_option("DIR", options.folders, "output folders")->required()->type_name("");
  collect.add_option("--out", options.out, "folder to merge into; what it holds stays")
      ->required()
      ->type_name("DIR");
  collect.footer("Example: grainsweep collect out/node1 out/node2 --out out/all");
}

void add_schema(CLI::App& app, SchemaOptions& options) {
  CLI::App& schema =
      *app.add_subcommand("schema", "Print the JSON Schema of sweep files, for editors");
  schema.add_flag("--markdown", options.markdown,
                  "the table of parameters instead: type, range, default, meaning");
  schema.footer("Example: grainsweep schema >sweep.schema.json");
}

void add_columns(CLI::App& app, ColumnsOptions& options) {
  CLI::App& columns = *app.add_subcommand("columns", "Say what the columns of the tables mean");
  columns.add_flag("--markdown", options.markdown, "as tables in Markdown, not CSV");
  columns.footer("Example: grainsweep columns");
}

void add_commands(CLI::App& app, AllOptions& options) {
  add_run(app, options.run);
  add_validate(app, options.validate);
  add_plan(app, options.plan);
  add_report(app, options.report);
  add_compare(app, options.compare);
  add_export(app, options.grains);
  add_status(app, options.status);
  add_collect(app, options.collect);
  add_schema(app, options.schema);
  add_columns(app, options.columns);
  app.add_subcommand("doctor", "Say what this machine offers and whether results can be written");
}

Command chosen_command(const CLI::App& app, const AllOptions& options) {
  const std::string name = app.get_subcommands().front()->get_name();
  if (name == "run") return options.run;
  if (name == "validate") return options.validate;
  if (name == "plan") return options.plan;
  if (name == "report") return options.report;
  if (name == "compare") return options.compare;
  if (name == "export") return options.grains;
  if (name == "status") return options.status;
  if (name == "collect") return options.collect;
  if (name == "schema") return options.schema;
  if (name == "columns") return options.columns;
  return options.doctor;
}

}  // namespace

CommandLine read_command_line(int argc, const char* const* argv) {
  AllOptions options;
  CLI::App app{
      "grainsweep " + program_version() +
          ": packs beds of rigid frictionless grains as a JSON sweep file says, and measures how\n"
          "walls change solid fraction and coordination number.",
      "grainsweep"};
  app.set_version_flag("--version", "grainsweep " + program_version());
  app.require_subcommand(1);
  app.get_formatter()->column_width(24);
  app.footer(std::string("Example: grainsweep run configs/quick.json --out out/quick\n"
                         "Help on a command: grainsweep run --help\n\n") +
             exit_codes_text);
  add_commands(app, options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return {std::nullopt, app.exit(error) == 0 ? exit_done : exit_bad_input};
  }
  return {chosen_command(app, options), exit_done};
}

}  // namespace grainsweep
