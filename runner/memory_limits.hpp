// What limits on memory leave to this process: control groups, nested as batch systems and
// containers make them, and `ulimit -v`.
#pragma once

#include <string>
#include <string_view>

namespace grainsweep {

/// The least that a control group of this process or one above it leaves, bytes; infinite without
/// limits. What a group holds of files and can drop counts as free. `groups`: the text of
/// /proc/self/cgroup, of version 1, 2 or both; `root`: where their file systems are,
/// /sys/fs/cgroup.
double memory_left_in_groups(std::string_view groups, const std::string& root);

/// What the limit on the addresses of this process leaves, bytes; infinite if there is none.
double addresses_left();

}  // namespace grainsweep
