// haptic_server --measure-arm: measures the arm of --device and writes its profile, instead of a session.
#pragma once

#include <atomic>

#include "common/program/program_output.h"
#include "haptic_server/program/server_options.h"

namespace osteomill {

/// Throws std::runtime_error with one line if there is no arm or the measurement ended before there was a
/// spring; nothing is written then. What was found is on standard output by then.
void run_measuring(const ServerOptions& options, const std::atomic<bool>& stop, const ProgramOutput& output);

}  // namespace osteomill
