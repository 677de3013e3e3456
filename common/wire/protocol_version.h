// The version of the protocol in proto/osteomill/v1. Another major version cannot be understood; a higher
// minor one says more than an older reader knows of.
#pragma once

#include <cstdint>

namespace osteomill {

inline constexpr std::uint32_t protocol_major = 1;
inline constexpr std::uint32_t protocol_minor = 10;  // 1: each frame of a server carries its checksum

/// From here on a server compares bones: see CompareBone.
inline constexpr std::uint32_t first_minor_that_compares = 2;
/// From here on a server wants to be greeted: see ClientHello. An older one would not understand it.
inline constexpr std::uint32_t first_minor_that_is_greeted = 3;
/// From here on an operator's input names the newest state that its client has seen, and a server moves the
/// tool for no other: see OperatorInput.
inline constexpr std::uint32_t first_minor_that_names_states = 5;

/// From here on a server takes a SessionControl.
inline constexpr std::uint32_t first_minor_with_controls = 10;
/// From here on a client knows what to do with StructureBricks.
inline constexpr std::uint32_t first_minor_with_structures = 10;

}  // namespace osteomill
