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

/// Throws BadInput if the path of the sweep or of its folder has a control character: a line of a
/// script ends where a name has a line feed, and a shell would run the rest.
void refuse_controls(const std::string& file, const std::string& folder);

/// <folder>/slurm, where scripts and logs are.
std::string scripts_folder(const std::string& folder);

/// The array of shards.
std::string shards_script(const ClusterRun& run);

/// The job after it: makes what is missing, in as many turns as that takes, and writes tables and
/// page.
std::string rest_script(const ClusterRun& run);

}  // namespace grainsweep
