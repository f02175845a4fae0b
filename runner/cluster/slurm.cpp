#include "runner/cluster/slurm.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>

#include "runner/exit_codes.hpp"
#include "runner/jobs/time_limit.hpp"
#include "runner/machine.hpp"
#include "runner/sweep/text_lines.hpp"
#include "runner/text.hpp"

namespace grainsweep {
namespace {

constexpr int not_found = 127;  // what a shell ends with

constexpr const char* without_slurm =
    "; call this where jobs of Slurm are submitted. Without Slurm: run --shard, and the scripts "
    "for "
    "other engines in configs/cluster";

/// What a command of Slurm printed. `name` is its first word.
std::string answer_to(const std::string& name, const std::string& options) {
  Said said = said_by(name + " " + options + " 2>&1");
  if (said.code == not_found) throw NoCluster(name + ": not found" + without_slurm);
  if (said.code != 0) throw BadInput(name + ": " + said.text);
  return std::move(said.text);
}

/// The same of a question to the cluster, which fails where there is none.
std::string cluster_said(const std::string& name, const std::string& options) try {
  return answer_to(name, options);
} catch (const NoCluster&) {
  throw;
} catch (const BadInput& error) {
  throw NoCluster(error.what() + std::string("\nno cluster answers") + without_slurm);
}

/// The number at the front; 0 if there is none. "2+" is what Slurm calls two or more.
int leading_number(std::string_view text) {
  int number = 0;
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

/// Seconds in "1-12:00:00" or "30:00"; 0 if there is no limit.
double limit_in(std::string_view text) {
  const std::size_t dash = text.find('-');
  if (dash == std::string_view::npos) return seconds_in(text).value_or(0.0);
  return 86400.0 * leading_number(text) + seconds_in(text.substr(dash + 1)).value_or(0.0);
}

/// In bytes; infinite for nodes whose memory was not configured, which say 1 MB.
double memory_in(std::string_view megabytes) {
  const int number = leading_number(megabytes);
  return number > 1 ? 1048576.0 * number : std::numeric_limits<double>::infinity();
}

void add(const Partition& some, std::vector<Partition>& partitions) {
  const auto known = std::find_if(partitions.begin(), partitions.end(),
                                  [&](const Partition& p) { return p.name == some.name; });
  if (known == partitions.end()) {
    partitions.push_back(some);
    return;
  }
  ClusterLimits& limits = known->limits;
  limits.nodes += some.limits.nodes;
  limits.cores = std::min(limits.cores, some.limits.cores);
  limits.memory = std::min(limits.memory, some.limits.memory);
}

std::string names_of(const std::vector<Partition>& partitions) {
  std::string names;
  for (const Partition& partition : partitions) {
    names += (names.empty() ? "" : ", ") + partition.name;
  }
  return names.empty() ? "none" : names;
}

}  // namespace

std::vector<Partition> partitions_in(std::string_view lines) {
  std::vector<Partition> partitions;
  for (const std::string_view line : pieces_of(lines, '\n')) {
    const auto fields = pieces_of(line, '|');
    if (fields.size() != 5) continue;  // a warning of sinfo
    Partition partition;
    partition.name = fields[0];
    partition.is_default = fields[0].ends_with('*');
    if (partition.is_default) partition.name.pop_back();
    partition.limits.seconds = limit_in(fields[1]);
    partition.limits.cores = std::max(1, leading_number(fields[2]));
    partition.limits.memory = memory_in(fields[3]);
    partition.limits.nodes = leading_number(fields[4]);
    add(partition, partitions);
  }
  return partitions;
}

int array_limit_in(std::string_view configuration) {
  for (const std::string_view line : pieces_of(configuration, '\n')) {
    if (!line.starts_with("MaxArraySize")) continue;
    const std::size_t number = line.find_first_of("0123456789");
    if (number == std::string_view::npos) return 0;
    // The limit is one above the greatest number of an element, and ours count from 1.
    const int limit = leading_number(line.substr(number)) - 1;
    if (limit < 1) {
      throw BadInput(
          "this cluster takes no arrays of jobs (MaxArraySize is " + std::to_string(limit + 1) +
          "); run the sweep in one job, or its shards as tasks of one: configs/cluster/srun.sh");
    }
    return limit;
  }
  return 0;
}

const Partition& chosen(const std::vector<Partition>& partitions, const std::string& name) {
  const auto found =
      std::find_if(partitions.begin(), partitions.end(), [&](const Partition& partition) {
        return name.empty() ? partition.is_default : partition.name == name;
      });
  if (found == partitions.end()) {
    throw BadInput((name.empty()
                        ? "this cluster has no default partition; give one with --partition"
                        : "--partition " + name + ": this cluster has none of that name") +
                   "; it has: " + names_of(partitions));
  }
  if (found->limits.nodes == 0) throw BadInput("partition " + found->name + " has no nodes");
  return *found;
}

Partition ask_for_partition(const std::string& name) {
  const std::string lines = cluster_said("sinfo", "--noheader --exact --format='%P|%l|%c|%m|%D'");
  Partition partition = chosen(partitions_in(lines), name);
  partition.limits.elements = array_limit_in(cluster_said("scontrol", "show config"));
  return partition;
}

std::string submit(const std::string& script, const std::string& after) {
  const std::string dependency = after.empty() ? "" : "--dependency=afterany:" + after + " ";
  const std::string answer = answer_to("sbatch", "--parsable " + dependency + shell_word(script));
  const std::string last = std::string(pieces_of(answer, '\n').back());  // behind any warning
  return last.substr(0, last.find(';'));                                 // a cluster's name follows
}

Queue queue_in(std::string_view lines, const std::string& scripts) {
  Queue queue;
  for (const std::string_view line : pieces_of(lines, '\n')) {
    const auto fields = pieces_of(line, '|');
    if (fields.size() != 3 || !fields[2].starts_with(scripts + "/")) continue;
    const std::string_view state = fields[0], reason = fields[1];
    const bool runs = state == "RUNNING" || state == "COMPLETING" || state == "CONFIGURING";
    ++(runs ? queue.running : queue.pending);
    constexpr std::array waiting = {"None", "Priority", "Resources", "Dependency", "BeginTime"};
    const bool waits = std::find(waiting.begin(), waiting.end(), reason) != waiting.end();
    if (!runs && !waits && queue.blocking.empty()) queue.blocking = reason;
  }
  return queue;
}

std::optional<Queue> ask_for_queue(const std::string& scripts) {
  const Said said = said_by("squeue --me --noheader --array --format='%T|%r|%o' 2>&1");
  if (said.code != 0) return std::nullopt;
  return queue_in(said.text, scripts);
}

}  // namespace grainsweep
