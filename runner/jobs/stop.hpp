// Ctrl-C, SIGTERM and their kin: the first asks to stop and keep what is finished, a second Ctrl-C
// ends at once.
#pragma once

namespace grainsweep {

/// From now on SIGINT, SIGTERM and SIGUSR1 (a batch system's warning) ask to stop, SIGXCPU (a limit
/// of CPU time) and, unless it was ignored as by nohup, SIGHUP (a closed terminal), too. SIGINT
/// after any of them exits with 128 + signal immediately; that loses no finished packing, since
/// each is on the disk before it counts. The others may come again and again: a job's launcher and
/// its batch system both send theirs. A closed pipe that output goes to ends nothing from now on.
void watch_stop_signals();

/// From now on, a file larger than its limit is a write error, not the end of the program.
void ignore_file_size_signal();

/// Signal that asked to stop, 0 if none did.
int stop_signal();

}  // namespace grainsweep
