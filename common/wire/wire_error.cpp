#include "common/wire/wire_error.h"

#include <algorithm>

namespace osteomill {

namespace {

constexpr std::size_t longest_text_bytes = 200;

bool continues_character(char byte) {
    return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U;
}

bool is_control(char byte) {
    const auto code = static_cast<unsigned char>(byte);
    return code < 0x20U || code == 0x7FU;
}

}  // namespace

std::string one_line(std::string_view from_peer) {
    std::size_t kept = std::min(from_peer.size(), longest_text_bytes);
    if (kept < from_peer.size())
        while (kept > 0 && continues_character(from_peer[kept])) --kept;
    std::string line(from_peer.substr(0, kept));
    std::ranges::replace_if(line, is_control, '?');
    if (kept < from_peer.size()) line += "...";
    return line;
}

}  // namespace osteomill
