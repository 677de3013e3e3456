// The newest command of the operator, from the streaming loop to the device, with --device client.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "common/session/operator_command.h"
#include "simulation/exchange/triple_buffer.h"

namespace osteomill {

/// The operator's newest command; nothing while none is connected. The reader accepts a command for no longer
/// than Permission::by_message_s.
struct HeardCommand {
    std::optional<OperatorCommand> command{};
    std::chrono::steady_clock::time_point heard{};
    std::uint64_t client = 0;  ///< another number where another client says it
    /// Commands of this client so far with the pedal up: the reader sees the newest command alone, and would
    /// miss a pedal that was up for one command.
    std::uint64_t releases = 0;
};

using OperatorChannel = TripleBuffer<HeardCommand>;

}  // namespace osteomill
