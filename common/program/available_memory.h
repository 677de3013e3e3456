// Memory that this machine has to spare.
#pragma once

#include <cstdint>
#include <istream>
#include <optional>

namespace osteomill {

/// MemAvailable of /proc/meminfo, in bytes; std::nullopt where the text has none.
std::optional<std::uint64_t> available_memory_bytes(std::istream& meminfo);

}  // namespace osteomill
