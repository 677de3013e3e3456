// The signals that end a program, as a flag: what it has to save is saved first.
#pragma once

#include <atomic>

namespace osteomill {

/// From now on SIGINT, SIGTERM and SIGHUP (the terminal is gone; not under nohup) set the flag, and nothing
/// else, however often they come. A pipe that nobody reads any more, and a file over the limit of `ulimit
/// -f`, fail like a full disk rather than end the program.
const std::atomic<bool>& stop_on_signals();

/// From now on these signals end the program at once: for who has nothing to save but may have to wait.
void end_on_signals();

/// The second half of stop_on_signals() alone.
void ignore_signals_of_streams();

}  // namespace osteomill
