// Memory that the system has given this program.
#pragma once

#include <cstdint>
#include <istream>
#include <optional>

namespace osteomill {

/// The most bytes that were resident at once: VmHWM of the text of /proc/self/status; std::nullopt if it
/// has none. (getrusage would also count the resident memory of the program that started this one.)
std::optional<std::uint64_t> peak_resident_bytes(std::istream& status);

}  // namespace osteomill
