// Pictures of the built-in cases for their cards on the start page, as PNG files in the program.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace osteomill {

struct CasePicture {
    std::string_view name;  ///< the case's
    std::span<const std::uint8_t> png;
};

/// Those in the folder case_pictures.
std::span<const CasePicture> case_pictures();

}  // namespace osteomill
