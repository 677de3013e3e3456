// haptic_server without its main: builds the parts that the options ask for and runs them to the end.
#pragma once

#include <atomic>
#include <string>

#include "common/log/line_stream.h"
#include "haptic_server/program/server_options.h"

namespace osteomill {

/// Gives the flag that asks to end; from then on, signals set it (run_program.h).
using StopFlag = const std::atomic<bool>& (*)();

/// Runs until the duration or the trajectory ends, or the stop flag is set from anywhere. The flag is asked
/// for once the bone is loaded: until then there is nothing to save, and a signal may end the program at
/// once. Says "listening on ADDRESS:PORT" on standard output once clients can connect, and progress on
/// standard error; neither can hold it up. Throws std::exception with one line for whatever stands in the
/// way; a log or measurement that could not be written is one of these, after the session.
void run_server(const ServerOptions& options, const std::string& version, StopFlag stop_flag,
                const ProgramOutput& output);

}  // namespace osteomill
