// The commands of the program, a file each.
//
// Every command has: its options; `add_command`, which describes it to the command line and says
// where its options go; and `perform`, which does it. That returns the program's exit code and
// throws BadInput, FolderBusy or FileError where it cannot go on.
#pragma once

#include <string>
#include <vector>

namespace CLI {  // NOLINT(readability-identifier-naming): as CLI11 calls it
class App;
}

namespace grainsweep {

struct RunOptions {
  std::string file;                  ///< sweep file
  std::string out;                   ///< output folder; empty: out/<sweep name>
  int threads = 0;                   ///< packings at once; 0: one per usable core
  std::string isa;                   ///< instruction set; empty: GRAINSWEEP_ISA, else the widest
  bool fresh = false;                ///< forget what is stored in the folder
  bool yes = false;                  ///< do not ask before forgetting
  double checkpoint_seconds = 60.0;  ///< wall time between two checkpoints of a packing
  bool retry_failed = false;         ///< make failed packings again
  bool fail_fast = false;            ///< stop at the first packing that fails
  bool quiet = false;                ///< print errors and warnings only
  bool no_report = false;            ///< leave out report.html and its figures
  bool no_grains = false;            ///< store curves but no grains
  bool with_grains = false;          ///< make again what is stored without grains
  std::vector<std::string> jobs;     ///< ids, or how they begin; empty: all of the shard
  std::string shard;                 ///< as shard_from_option takes it
  bool alone = false;                ///< take over nothing from other shards
  std::string time_limit;            ///< "1:30:00"; empty: that of the Slurm job, if any
  double tolerate_unsettled = 0.0;   ///< unsettled share, 0..1, that does not affect the exit code
  std::string repeated;              ///< options with which a stopped run goes on, for a shell
};
/// Makes the missing packings of a sweep and writes the tables.
int perform(const RunOptions& options);
void add_command(CLI::App& app, RunOptions& options);

struct InitOptions {
  std::string name = "my-sweep";
};
/// Writes a sweep file to start from, and the schema of sweep files beside it. Replaces no sweep.
int perform(const InitOptions& options);
void add_command(CLI::App& app, InitOptions& options);

struct ValidateOptions {
  std::string file;
};
/// Says whether a sweep file is right, and how many packings it stands for.
int perform(const ValidateOptions& options);
void add_command(CLI::App& app, ValidateOptions& options);

struct PlanOptions {
  std::string file;
  std::string out;  ///< output folder whose packings improve the estimates; empty: none
  int threads = 0;  ///< as in RunOptions
  int shards = 0;   ///< number of parts whose costs to print; 0: none
  bool json = false;
};
/// Prints the packings of a sweep with estimated time and memory.
int perform(const PlanOptions& options);
void add_command(CLI::App& app, PlanOptions& options);

struct SlurmOptions {
  std::string file;
  std::string out;                  ///< as in RunOptions
  std::string partition;            ///< empty: the cluster's default
  int shards = 0;                   ///< 0: as many as divide() says
  int threads = 0;                  ///< of a shard; 0: all cores of a node
  double tolerate_unsettled = 0.0;  ///< as in RunOptions, for the last job
  bool print = false;               ///< print the scripts instead of submitting them
};
/// Submits a sweep to Slurm: an array of shards, and a job that makes the rest and the tables.
int perform(const SlurmOptions& options);
void add_command(CLI::App& app, SlurmOptions& options);

struct ReportOptions {
  std::string folder;
};
/// Prints the closing table from stored results and writes report.html.
int perform(const ReportOptions& options);
void add_command(CLI::App& app, ReportOptions& options);

struct CompareOptions {
  std::string folder;
  std::string with;     ///< file of published values; empty: the one beside the sweep file
  bool as_csv = false;  ///< as comparison.csv, not as a table for people
};
/// Prints stored results beside published values.
int perform(const CompareOptions& options);
void add_command(CLI::App& app, CompareOptions& options);

struct ExportOptions {
  std::string folder;
  std::string format = "csv";      ///< one of export_formats, or html
  std::vector<std::string> jobs;   ///< ids, or how they begin; empty: all that are stored
  std::string to;                  ///< folder for the files; empty: <folder>/export
  std::string contacts = "touch";  ///< for surfaces: touch, shrink:SHARE, cap:SHARE or bridge:SHARE
  bool in_units = false;           ///< for grains, surfaces and voxels: lengths in the sweep's unit
  bool periodic_images = false;    ///< for surfaces: images of grains that cross a periodic side
  double voxels = 20.0;            ///< per d
  bool quiet = false;              ///< print no progress
};
/// Writes the grains of stored packings, a file each.
int perform(const ExportOptions& options);
void add_command(CLI::App& app, ExportOptions& options);

struct StatusOptions {
  std::vector<std::string> folders;
  bool json = false;
  bool check = false;  ///< reads every file of grains whole
};
/// Prints how much of a sweep is done, and whether a runner is at work.
int perform(const StatusOptions& options);
void add_command(CLI::App& app, StatusOptions& options);

struct CollectOptions {
  std::vector<std::string> folders;
  std::string out;       ///< folder they are merged into; may hold results, which stay
  bool current = false;  ///< leave out what their sweeps do not ask for
};
/// Merges the results of several output folders, each packing once, and writes the tables.
int perform(const CollectOptions& options);
void add_command(CLI::App& app, CollectOptions& options);

struct ColumnsOptions {
  bool markdown = false;  ///< a table in GitHub's Markdown for each file, not CSV
};
/// Prints file, name, unit and meaning of the columns of all tables.
int perform(const ColumnsOptions& options);
void add_command(CLI::App& app, ColumnsOptions& options);

struct SchemaOptions {
  bool markdown = false;  ///< the table of parameters for a manual instead
};
/// Prints the JSON Schema of sweep files.
int perform(const SchemaOptions& options);
void add_command(CLI::App& app, SchemaOptions& options);

struct ManualOptions {
  std::string folder;
};
/// Writes manual pages and completions of shells into a folder.
int perform(const ManualOptions& options);
void add_command(CLI::App& app, ManualOptions& options);

struct DoctorOptions {};
/// Prints what the machine offers and tries to write a file here.
int perform(const DoctorOptions& options);
void add_command(CLI::App& app, DoctorOptions& options);

}  // namespace grainsweep
