// Memory that this machine has to spare.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

namespace osteomill {

/// MemAvailable in bytes; std::nullopt if the file is none or has none.
std::optional<std::uint64_t> available_memory_bytes(const std::filesystem::path& meminfo = "/proc/meminfo");

}  // namespace osteomill
