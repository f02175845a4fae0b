// The scripts by which Slurm makes a sweep.
#pragma once

#include <string>

#include "runner/cluster/slurm.hpp"

namespace grainsweep {

/// What scripts are made of. Paths are absolute: a job may be submitted from anywhere.
struct ClusterRun {
  std::string program, file, folder;
  std::string name;                ///< of the sweep
  std::string partition;           ///< of the cluster
  std::string tolerate_unsettled;  ///< as in RunOptions, for the last job
  Division division;
};

/// <folder>/slurm, where scripts and logs are.
std::string scripts_folder(const std::string& folder);

/// The array of shards.
std::string shards_script(const ClusterRun& run);

/// The job after it: makes what is missing, in as many turns as that takes, and writes tables and
/// page.
std::string rest_script(const ClusterRun& run);

}  // namespace grainsweep
