// A picture as a PNG within a page: data:image/png;base64,... (libpng, OpenSSL).
#pragma once

#include <string>

#include "imaging/picture/bone_view.h"

namespace osteomill {

/// Throws std::runtime_error if libpng fails.
std::string png_data_uri(const RgbPicture& picture);

}  // namespace osteomill
