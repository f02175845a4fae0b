#include "runner/cluster/job_scripts.hpp"

#include <array>
#include <cmath>
#include <cstdio>

#include "runner/exit_codes.hpp"
#include "runner/sweep/text_lines.hpp"
#include "runner/text.hpp"

namespace grainsweep {
namespace {

std::string clock_time(double seconds) {
  const long minutes = std::lround(std::ceil(seconds / 60.0));
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%ld:%02ld:00", minutes / 60, minutes % 60);
  return text.data();
}

/// For a file name that Slurm reads, to which % is special.
std::string without_patterns(const std::string& name) {
  std::string text;
  for (const char c : name) text += c == '%' ? std::string("%%") : std::string(1, c);
  return text;
}

std::string directive(const std::string& text) { return "#SBATCH --" + text + "\n"; }

/// What both jobs ask for. `log` is the name of the file for a job's output.
std::string directives(const ClusterRun& run, const std::string& log) {
  const Division& division = run.division;
  std::string text = directive("job-name=" + shell_word(run.name)) +
                     (run.partition.empty() ? "" : directive("partition=" + run.partition)) +
                     directive("nodes=1") + directive("ntasks=1") +
                     directive("cpus-per-task=" + std::to_string(division.threads));
  if (division.bytes > 0.0) {
    text += directive("mem=" + std::to_string(std::llround(division.bytes / 1048576.0)) + "M");
  }
  return text + directive("time=" + clock_time(division.seconds)) + directive("requeue") +
         directive("open-mode=append") +
         directive("output=" +
                   shell_word(without_patterns(scripts_folder(run.folder)) + "/" + log));
}

std::string command(const ClusterRun& run) {
  return shell_word(run.program) + " run " + shell_path(run.file) + " --out " +
         shell_path(run.folder) + " --threads " + std::to_string(run.division.threads) + " --quiet";
}

}  // namespace

void refuse_controls(const std::string& file, const std::string& folder) {
  const auto refuse = [](const std::string& path, const std::string& what,
                         const std::string& remedy) {
    const std::string shown = without_controls(path);
    if (shown == path) return;
    throw BadInput(what + ": \"" + shown +
                   "\" holds a control character, as a line feed is, and the lines of a script "
                   "cannot; " +
                   remedy);
  };
  refuse(file, "FILE", "rename the sweep or its folder");
  refuse(folder, "--out", "name another folder");
}

std::string scripts_folder(const std::string& folder) { return folder + "/slurm"; }

std::string shards_script(const ClusterRun& run) {
  const std::string count = std::to_string(run.division.shards);
  return "#!/bin/bash\n# Makes " + run.name +
         " in shards, each on one node. To make number 3 again: "
         "sbatch --array=3 with this file.\n" +
         directive("array=1-" + count) + directives(run, "%a.log") +
         "# Told 90 s before its time is up, and before it has to make way; it saves what is under "
         "way.\n" +
         directive("signal=B:TERM@90") + "exec " + command(run) +
         " --shard \"$SLURM_ARRAY_TASK_ID/" + count + "\" --no-report --tolerate-unsettled\n";
}

std::string rest_script(const ClusterRun& run) {
  const std::string tolerance =
      run.tolerate_unsettled.empty() ? "" : " --tolerate-unsettled=" + run.tolerate_unsettled;
  return "#!/bin/bash\n# Makes what shards have left of " + run.name +
         ", and writes tables and page. Its run has to know the time that the job has.\n" +
         directives(run, "rest.log") + command(run) + " --time-limit " +
         clock_time(run.division.seconds) + tolerance +
         "\ncode=$?\n# Out of time, with what is under way saved: once more.\n"
         "if [ $code -eq 6 ]; then exec scontrol requeue \"$SLURM_JOB_ID\"; fi\n"
         "exit $code\n";
}

}  // namespace grainsweep
