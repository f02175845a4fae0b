// The command `slurm`: a sweep as jobs of a cluster.
#include <cmath>
#include <filesystem>
#include <iostream>

#include <CLI/App.hpp>

#include "runner/cluster/job_scripts.hpp"
#include "runner/commands/commands.hpp"
#include "runner/commands/inputs.hpp"
#include "runner/commands/shared_options.hpp"
#include "runner/exit_codes.hpp"
#include "runner/jobs/estimates.hpp"
#include "runner/jobs/growing_groups.hpp"
#include "runner/jobs/schedule.hpp"
#include "runner/jobs/sweep_parts.hpp"
#include "runner/machine.hpp"
#include "runner/store/files.hpp"
#include "runner/sweep/costs.hpp"
#include "runner/tables/csv.hpp"
#include "runner/text.hpp"

namespace grainsweep {
namespace {

std::string absolute(const std::string& path) {
  return std::filesystem::absolute(path).lexically_normal().string();
}

ClusterRun cluster_run(const SlurmOptions& options, const Sweep& sweep, const std::string& folder,
                       const Partition& partition, const Division& division) {
  return {std::filesystem::read_symlink("/proc/self/exe").string(),
          absolute(options.file),
          absolute(folder),
          sweep.name,
          partition.name,
          options.tolerate_unsettled > 0.0 ? cell(options.tolerate_unsettled) : "",
          division};
}

/// The partition of the cluster. Where there is none, scripts can be printed all the same if the
/// options decide in its place: then one without limits.
Partition partition_for(const SlurmOptions& options) try {
  return ask_for_partition(options.partition);
} catch (const NoCluster& error) {
  const bool decide = options.shards > 0 && options.threads > 0;
  if (!options.print) throw;
  if (!decide) {
    throw BadInput(std::string(error.what()) +
                   "\nTo print the scripts here, give --shards and --threads");
  }
  std::cerr
      << "note: no cluster answers here: --shards and --threads decide, and no memory is asked "
         "for"
      << (options.partition.empty() ? ", nor a partition" : "") << "\n";
  Partition partition;
  partition.name = options.partition;
  partition.limits.nodes = options.shards;
  partition.limits.cores = options.threads;
  return partition;
}

std::string limits_text(const Partition& partition) {
  const ClusterLimits& limits = partition.limits;
  std::string text = (partition.name.empty() ? "Asked for" : "Partition " + partition.name) + ": " +
                     counted(static_cast<std::size_t>(limits.nodes), "node") + " of " +
                     counted(static_cast<std::size_t>(limits.cores), "core");
  if (std::isfinite(limits.memory)) text += " and " + fixed(limits.memory / 1e9, 1) + " GB";
  if (limits.seconds > 0.0) text += ", " + duration_text(limits.seconds) + " a job";
  if (limits.elements > 0) text += ", " + std::to_string(limits.elements) + " elements an array";
  return text + "\n";
}

/// What will be done, and what decided it. `costs`: of the packings made at first.
std::string division_text(const Sweep& sweep, const std::vector<Cost>& costs,
                          const Division& division, const ClusterLimits& limits) {
  std::string text = sweep.name + ": " + counted(costs.size(), "packing") +
                     (grows(sweep) ? " at first" : "") + ", about " +
                     duration_text(total_cpu_seconds(costs)) +
                     " CPU: " + counted(static_cast<std::size_t>(division.shards), "shard") +
                     " of about " + duration_text(division.estimated) + " on " +
                     counted(static_cast<std::size_t>(division.threads), "core") +
                     "\nDecided by: " + division.reason + "\n";
  if (division.threads < limits.cores) {
    text += "Cores left idle on a node: " + std::to_string(limits.cores - division.threads) + "\n";
  }
  return text;
}

/// What a growing sweep may take, and what is asked for.
std::string growth_of_shards_text(const std::vector<Cost>& most, const Division& division) {
  return growth_text(most) + ", the longest shard " + duration_text(division.grown) +
         "; each asks for " + duration_text(division.seconds) +
         ", and what it leaves is made by the job that follows\n";
}

/// Says so if one machine is enough, whatever grows. `most`: costs of all that there may be.
std::string small_note(const std::vector<Cost>& most, const SlurmOptions& options,
                       const std::string& folder) {
  const double seconds = estimate_wall(most, usable_cores());
  if (seconds > 3600.0) return "";
  return "note: this machine makes it in about " + duration_text(seconds) +
         ", no cluster is needed: " + called_as() + " run " + shell_path(options.file) + " --out " +
         shell_path(folder) + "\n";
}

/// Submits the shards. Scripts that are refused are removed: they would look as if they wait.
std::string submit_shards(const std::string& scripts) try {
  return submit(scripts + "/shards.sh");
} catch (...) {
  std::error_code stays;  // the folder stays if it has logs of earlier jobs
  for (const char* name : {"/shards.sh", "/rest.sh", ""}) {
    std::filesystem::remove(scripts + name, stays);
  }
  throw;
}

/// Submits the job after the shards, which go on if it is refused.
std::string submit_rest(const std::string& scripts, const std::string& array) try {
  return submit(scripts + "/rest.sh", array);
} catch (const BadInput& refused) {
  throw BadInput(std::string(refused.what()) +
                 "\nThe shards are submitted, and the job that ends "
                 "the sweep is not. When they are done: sbatch " +
                 shell_word(scripts + "/rest.sh") + "; to end them: scancel " + array);
}

/// Writes the scripts and submits them, the second to run after the first.
void submit_scripts(const ClusterRun& run, const std::string& folder) {
  const std::string scripts = scripts_folder(run.folder);
  make_folder(scripts);
  replace_file(scripts + "/shards.sh", shards_script(run));
  replace_file(scripts + "/rest.sh", rest_script(run));
  const std::string array = submit_shards(scripts);
  std::cout << "Submitted job " << array << ", an array of "
            << counted(static_cast<std::size_t>(run.division.shards), "shard") << std::endl;
  const std::string rest = submit_rest(scripts, array);
  std::cout << "Submitted job " << rest << ", which follows: the rest, tables and page\n"
            << "Scripts and logs are in " << scripts_folder(folder)
            << ". How far it is: " << called_as() << " status " << shell_path(folder)
            << "; to end it: scancel " << array << " " << rest << "\n";
}

}  // namespace

void add_command(CLI::App& app, SlurmOptions& options) {
  CLI::App& slurm = *app.add_subcommand(
      "slurm", "Submit a sweep to Slurm as an array of shards, and a job that ends it");
  add_file(slurm, options.file);
  slurm
      .add_option("--out", options.out,
                  "output folder, which all nodes see (default: out/<sweep name>)")
      ->check(not_empty())
      ->type_name("DIR");
  slurm.add_flag("--print", options.print, "print the scripts; write and submit nothing");
  slurm.add_option("--partition", options.partition, "of the cluster (default: its default)")
      ->type_name("NAME");
  slurm.add_option("--shards", options.shards, "how many (default: of 10 to 60 min a node)")
      ->check(CLI::Range(1, most_shards))
      ->type_name("N");
  slurm.add_option("--threads", options.threads, "cores of a shard (default: all of a node)")
      ->check(CLI::Range(1, 1024))
      ->type_name("N");
  add_tolerance(slurm, options.tolerate_unsettled,
                "as of run, for the job that ends it; shards always do");
  slurm.footer(
      "Example: grainsweep slurm sweep.json --out out/sweep --print\n\n"
      "The environment of sbatch counts: SBATCH_ACCOUNT, SBATCH_QOS and the others of\n"
      "its manual.");
}

int perform(const SlurmOptions& options) {
  const Sweep whole = sweep_with_notes(options.file);
  const std::string folder = options.out.empty() ? "out/" + whole.name : options.out;
  const std::vector<Cost> most = costs_of(whole.jobs);
  const std::vector<Cost> costs = costs_of(GrowingSweep(whole, {}).now().jobs);
  refuse_controls(absolute(options.file), absolute(folder));
  const Partition partition = partition_for(options);
  const Division division =
      divide(parts_of(whole, most), most, partition.limits, options.shards, options.threads);
  std::cerr << memory_warning(costs, partition.limits.memory) << limits_text(partition)
            << division_text(whole, costs, division, partition.limits)
            << (grows(whole) ? growth_of_shards_text(most, division) : "")
            << small_note(most, options, folder);
  const ClusterRun run = cluster_run(options, whole, folder, partition, division);
  if (options.print) {
    std::cout << shards_script(run) << "\n" << rest_script(run);
  } else {
    submit_scripts(run, folder);
  }
  return exit_done;
}

}  // namespace grainsweep
