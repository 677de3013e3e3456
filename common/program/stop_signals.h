// The signals that end a program, as a flag, so that it can save its data first.
#pragma once

#include <atomic>

namespace osteomill {

/// From now on SIGINT, SIGTERM and SIGHUP (lost terminal; not under nohup) set the flag, and do nothing more,
/// however often they come. A pipe without a reader, and a file over the limit of `ulimit -f`, fail like a
/// full disk instead of ending the program.
const std::atomic<bool>& stop_on_signals();

/// From now on these signals end the program at once: for a program with nothing to save that may have to
/// wait.
void end_on_signals();

/// The second half of stop_on_signals() alone.
void ignore_signals_of_streams();

}  // namespace osteomill
