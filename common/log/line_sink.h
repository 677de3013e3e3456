// The log of a program (spdlog) as lines of a stream that never blocks the caller.
#pragma once

#include <memory>
#include <string>

#include "common/log/line_stream.h"

namespace osteomill {

/// Makes spdlog's functions write to `stream`, each line headed with time, `program` and level, the level in
/// colour on a terminal. A line that cannot be formatted is left out.
void log_to(std::shared_ptr<LineStream> stream, const std::string& program);

}  // namespace osteomill
