// Ticks of the haptic loop in one message, compressed: how a recording holds every tick. Exact to the
// decimals of a log: unpacked, they make the same line.
//
// Packed: zstd of a TickQuantities, which has for each number of tick_quantities() the whole numbers of its
// last decimal, each less that of the tick before. Minus zero is a number of its own, -1, and -1 is -2, for a
// log tells it from zero. Each message stands alone, so that one may be lost.
#pragma once

#include <cstdint>
#include <span>
#include <variant>
#include <vector>

#include "common/session/tick_sample.h"
#include "common/wire/frame.h"
#include "common/wire/zstd_compressor.h"

namespace osteomill::v2 {
class Ticks;  // of session.pb.h, which takes long to parse
}

namespace osteomill {

/// The ticks of the longest pause between two states of a tool at rest. Even if nothing compresses, so many
/// fit a frame beside the largest changes.
inline constexpr std::size_t most_ticks_of_message = 128;

/// Ticks of a state frame.
struct TickBlock {
    std::uint64_t missed = 0;  ///< that should be before them: the recorder had no space
    std::vector<TickSample> ticks{};
    std::size_t bytes = 0;  ///< that they take in the frame
};

class TickPacker {
  public:
    TickPacker();
    /// At most most_ticks_of_message, all with a torque or none.
    v2::Ticks pack(std::uint64_t missed, std::span<const TickSample> ticks);

  private:
    ZstdCompressor compressor_;
};

/// The ticks that were packed, of a session with so many burrs. An error says what does not add up.
std::variant<TickBlock, WireError> unpack(const v2::Ticks& message, std::size_t burr_count);

}  // namespace osteomill
