// Check that a file lies within a folder, wherever links lead.
#pragma once

#include <filesystem>

namespace osteomill {

/// After all links are followed, of the folder's, too. A file that is not there lies where it would be made.
/// False if that cannot be found out.
bool lies_inside(const std::filesystem::path& file, const std::filesystem::path& folder);

}  // namespace osteomill
