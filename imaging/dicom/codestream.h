// An image as JPEG 2000, JPEG and JPEG-LS describe it in their own header, independently of the DICOM around
// them.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

namespace osteomill {

struct Codestream {
    std::uint32_t columns = 0;
    std::uint32_t rows = 0;  ///< 0: a JPEG that says so at its end
    std::uint32_t components = 0;
    std::optional<bool> is_signed{};  ///< only JPEG 2000 says
};

/// std::nullopt if the bytes begin like no JPEG.
std::optional<Codestream> codestream_of(std::span<const std::uint8_t> bytes);

}  // namespace osteomill
