// haptic_server --measure-arm: measures the arm of --device and writes its profile, instead of a session.
#pragma once

#include <atomic>

#include "common/log/line_stream.h"
#include "haptic_server/program/server_options.h"

namespace osteomill {

/// Throws std::runtime_error with one line if there is no arm or the measurement ended before there was a
/// spring; no profile is written then, but the findings are on standard output.
void run_measuring(const ServerOptions& options, const std::atomic<bool>& stop, const ProgramOutput& output);

}  // namespace osteomill
