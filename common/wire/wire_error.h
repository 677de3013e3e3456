// Why something that came over the wire was refused: one line for people, fit for a log.
#pragma once

#include <string>
#include <string_view>

namespace osteomill {

struct WireError {
    std::string line{};
};

/// Text that a peer sent, made fit for a line: each control character becomes '?', and what is longer than
/// 200 bytes ends in "...", cut between characters of UTF-8. So a peer can neither break a log nor steer a
/// terminal.
std::string one_line(std::string_view from_peer);

}  // namespace osteomill
