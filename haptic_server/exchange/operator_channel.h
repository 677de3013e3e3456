// The newest command of the operator, from the streaming loop to the device, with --device client.
#pragma once

#include <optional>

#include "common/scene/operator_command.h"
#include "haptic_server/exchange/triple_buffer.h"

namespace osteomill {

/// Nothing while no operator is connected. The reader gives a command no longer than
/// Permission::by_message_s.
using OperatorChannel = TripleBuffer<std::optional<OperatorCommand>>;

}  // namespace osteomill
