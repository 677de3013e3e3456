// Files that a desktop leaves beside those of its user.
#pragma once

#include <filesystem>
#include <string>

#include "common/text/words.h"

namespace osteomill {

/// Whether the name is of one: "._scan.nii.gz", ".DS_Store", "Thumbs.db".
inline bool is_of_the_desktop(const std::filesystem::path& path) {
    const std::string name = lower_case(path.filename().string());
    return name.starts_with('.') || name == "thumbs.db" || name == "desktop.ini";
}

}  // namespace osteomill
