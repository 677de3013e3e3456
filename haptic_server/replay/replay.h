// packet_replay without its main.
#pragma once

#include <atomic>

#include "common/log/line_stream.h"
#include "haptic_server/replay/replay_options.h"

namespace osteomill {

/// Reads the recording, or shows it to clients until its end or `stop`. Prints "listening on ADDRESS:PORT" on
/// standard output once clients can connect. Throws std::exception with one line on the obstacle. If only the
/// later part of a recording cannot be read, it does so after the readable part.
void run_replay(const ReplayOptions& options, const std::atomic<bool>& stop, const ProgramOutput& output);

}  // namespace osteomill
