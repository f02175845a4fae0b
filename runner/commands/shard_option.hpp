// Which part of a sweep a runner is to make, as given on the command line or by a cluster.
#pragma once

#include <string>

#include "runner/machine.hpp"
#include "runner/store/shard.hpp"

namespace grainsweep {

/// "3/64"; "auto", from the variables of job arrays and tasks; or "auto/64" where the cluster gives
/// the number of a task but not how many there are. Empty: the whole sweep. Throws BadInput, which
/// lists the variables that were looked for.
Shard shard_from_option(const std::string& text, const Environment& environment);

}  // namespace grainsweep
