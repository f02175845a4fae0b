// How a sweep is divided among the nodes of a cluster.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "engine/cost.hpp"
#include "runner/jobs/sweep_parts.hpp"

namespace grainsweep {

/// What a part of a cluster offers.
struct ClusterLimits {
  int nodes = 1;
  int cores = 1;                                            ///< of a node
  double memory = std::numeric_limits<double>::infinity();  ///< of a node, bytes; if known
  double seconds = 0.0;  ///< that a job may take; 0 if there is no limit, or none known
  int elements = 0;      ///< that an array of jobs may have; 0 as above
};

/// Shards, each a job on one node.
struct Division {
  int shards = 1;
  int threads = 1;         ///< of a shard
  double bytes = 0.0;      ///< to ask for, for each shard; 0 where what a node has is not known
  double estimated = 0.0;  ///< wall time of the longest shard for what is made at first, s
  double grown = 0.0;      ///< the same if all that may grow has its most packings, s
  /// To ask for, for each shard, if allowed: `grown`, or twice `estimated` if that is more.
  double seconds = 0.0;
  std::string reason;  ///< what decided their number: "the 12 nodes of the partition"
};

/// As many shards as there are nodes, if each then takes a node 10 to 60 minutes, and at most a
/// third of the time that a job may take, since estimates may be too low by a factor of two;
/// otherwise the nearest number, and never more than parts. Growth of groups does not count here:
/// how many packings they take is known only when the first ones are made. A shard has a thread for
/// each core of a node, or as many as there is memory for. `costs` are those of all jobs. `shards`
/// and `threads` other than 0 are taken as they are, limited only by parts and memory.
Division divide(const std::vector<Part>& parts, const std::vector<Cost>& costs,
                const ClusterLimits& limits, int shards = 0, int threads = 0);

}  // namespace grainsweep
