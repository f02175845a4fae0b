// Slurm, through its commands. Every function throws BadInput if they are missing or refuse, with
// what they say.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runner/cluster/division.hpp"
#include "runner/exit_codes.hpp"

namespace grainsweep {

/// Slurm is not here, or has no cluster to answer for.
struct NoCluster : BadInput {
  using BadInput::BadInput;
};

struct Partition {
  std::string name;
  bool is_default = false;
  ClusterLimits limits;
};

/// What `sinfo` says of each partition, from lines "main*|1-00:00:00|2|1000|4": name, with a star
/// if it is the default, time limit, cores and MB of a node, nodes. Where the nodes of a partition
/// differ, the smallest values count.
std::vector<Partition> partitions_in(std::string_view lines);

/// How many elements an array may have, from what `scontrol show config` says; 0 if it does not
/// say. Throws BadInput if there may be no arrays.
int array_limit_in(std::string_view configuration);

/// The partition of that name, or the default one if the name is empty. Throws BadInput, which
/// lists the partitions that there are.
const Partition& chosen(const std::vector<Partition>& partitions, const std::string& name);

/// Asks the cluster. Throws NoCluster where there is none.
Partition ask_for_partition(const std::string& name);

/// Submits a script, which begins after all elements of the job `after` have ended, if that is not
/// empty; returns the job's number.
std::string submit(const std::string& script, const std::string& after = "");

/// Jobs and elements in the queue, by what they wait for.
struct Queue {
  int running = 0;
  int pending = 0;       ///< also those that were preempted or are to run again
  std::string blocking;  ///< why the first pending one will not begin by itself; usually empty
};

/// Counts those of the lines "RUNNING|None|/scripts/shards.sh" whose script lies in the folder.
Queue queue_in(std::string_view lines, const std::string& scripts);

/// The jobs of this user whose scripts lie in the folder; nothing where there is no Slurm.
std::optional<Queue> ask_for_queue(const std::string& scripts);

}  // namespace grainsweep
