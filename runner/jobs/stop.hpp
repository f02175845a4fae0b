// Ctrl-C, SIGTERM and a closed terminal: the first asks to stop and keep what is finished, the
// second ends at once.
#pragma once

namespace grainsweep {

/// From now on SIGINT, SIGTERM and, unless it is ignored, SIGHUP ask to stop. A second one exits
/// with 128 + signal immediately; that loses no finished packing, since each is on the disk before
/// it counts. A closed pipe that output goes to ends nothing from now on.
void watch_stop_signals();

/// Signal that asked to stop, 0 if none did.
int stop_signal();

}  // namespace grainsweep
