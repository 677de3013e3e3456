// A case: a folder with what a session needs of one patient. Its case.toml is a scene file; beside it lie
// bone.nrrd and, where there is one, the segmentation.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>

namespace osteomill {

/// What --scene takes for a case: the name of one that is built in, or a folder's case.toml. Throws
/// std::invalid_argument, with those built in and the nearest name, for what is neither.
std::string scene_of_case(const std::string& name);

/// The folder's own name, for people.
std::string name_of_case(const std::filesystem::path& folder);

/// Makes the folder. Throws std::runtime_error where it holds a case already, cannot be made, or the
/// segmentation cannot be read.
void begin_case(const std::filesystem::path& folder,
                const std::optional<std::filesystem::path>& segmentation);

/// Where a case's bone lies.
std::filesystem::path bone_of_case(const std::filesystem::path& folder);

/// Completes a case whose bone is there: copies the segmentation into it, makes a tissue of each segment that
/// lies in the bone's box, chooses where the tool starts, and writes case.toml, last. Segments outside are
/// told of in `messages`. Throws std::runtime_error in one line.
void finish_case(const std::filesystem::path& folder,
                 const std::optional<std::filesystem::path>& segmentation, std::ostream& messages);

}  // namespace osteomill
