// Trust in a case, which may be from elsewhere: it reads no file outside its folder, and its files without a
// digest are named.
#pragma once

#include <filesystem>
#include <string>

#include "common/scene/scene.h"

namespace osteomill {

/// Throws std::runtime_error if a file that the case's scene names lies outside the case's folder, after
/// links are followed.
void require_own_files(const Scene& scene, const std::filesystem::path& folder);

/// A text in TOML with its digest behind it, as a comment.
std::string with_digest(std::string text);

/// One line that names the files of a case that cannot be checked for damage: they have no digest or, in
/// TOML, which people edit, another. Empty if there are none. Throws as their readers do.
std::string unsigned_files(const Scene& scene, const std::filesystem::path& folder);

}  // namespace osteomill
