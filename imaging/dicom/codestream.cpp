#include "imaging/dicom/codestream.h"

#include <algorithm>

namespace osteomill {

namespace {

using Bytes = std::span<const std::uint8_t>;

std::uint32_t big_endian_at(Bytes bytes, std::size_t at, std::size_t count) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < count; ++i) value = value << 8U | bytes[at + i];
    return value;
}

std::optional<Codestream> jpeg2000(Bytes bytes) {
    // SOC, SIZ: length, capabilities, size, offset, tiles, number of components, depth of the first.
    constexpr std::size_t most_wrapping = 4096;  // bytes of the JP2 boxes that some files have around it
    for (std::size_t at = 0; at + 43 <= std::min(bytes.size(), most_wrapping); ++at) {
        if (big_endian_at(bytes, at, 4) != 0xff4fff51) continue;
        return Codestream{.columns = big_endian_at(bytes, at + 8, 4) - big_endian_at(bytes, at + 16, 4),
                          .rows = big_endian_at(bytes, at + 12, 4) - big_endian_at(bytes, at + 20, 4),
                          .components = big_endian_at(bytes, at + 40, 2),
                          .is_signed = (bytes[at + 42] & 0x80U) != 0};
    }
    return std::nullopt;
}

std::optional<Codestream> jpeg(Bytes bytes) {
    std::size_t at = 2;
    while (at + 10 <= bytes.size()) {
        if (bytes[at] != 0xff) return std::nullopt;
        const std::uint8_t marker = bytes[at + 1];
        if (marker == 0xff) {
            ++at;
            continue;
        }
        const bool is_frame =
            (marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc) ||
            marker == 0xf7;
        if (is_frame)
            return Codestream{.columns = big_endian_at(bytes, at + 7, 2),
                              .rows = big_endian_at(bytes, at + 5, 2),
                              .components = bytes[at + 9]};
        at += 2 + big_endian_at(bytes, at + 2, 2);
    }
    return std::nullopt;
}

}  // namespace

std::optional<Codestream> codestream_of(Bytes bytes) {
    if (bytes.size() >= 4 && bytes[0] == 0xff && bytes[1] == 0xd8) return jpeg(bytes);
    return jpeg2000(bytes);
}

}  // namespace osteomill
