// The version of the protocol in proto/osteomill/v2. Another major version cannot be understood; a higher
// minor one says more than an older reader knows of.
#pragma once

#include <cstdint>

namespace osteomill {

inline constexpr std::uint32_t protocol_major = 2;
inline constexpr std::uint32_t protocol_minor = 3;

}  // namespace osteomill
