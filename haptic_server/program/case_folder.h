// A case: a folder with what a session needs of one patient. Its case.toml is a scene file; beside it lie
// bone.nrrd and, where there is one, the segmentation on the bone's grid.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

namespace osteomill {

/// What --scene takes for a case: the name of one that is built in, or a folder's case.toml. Throws
/// std::invalid_argument, with those built in and the nearest name, for what is neither.
std::string scene_of_case(const std::string& name);

/// The folder's own name, for people.
std::string name_of_case(const std::filesystem::path& folder);

/// What a case is made of beside its bone.
struct CaseParts {
    std::vector<std::filesystem::path> segmentations{};  ///< all their segments become tissues
    std::optional<std::filesystem::path> colours{};  ///< names and colours of those that are plain label maps
    std::vector<std::string> is_protected{};         ///< tissues, by name
    double warn_mm = 1.0;                            ///< of those: from what distance on
    std::optional<std::string> target{};             ///< the tissue that is to be removed
};

/// Makes the folder. Returns the parts with names as the segmentations spell them: blanks and underscores are
/// alike. Throws std::runtime_error where it holds a case already, cannot be made, or a
/// segmentation or the colours cannot be read, or a name that is protected or the target is none of theirs.
CaseParts begin_case(const std::filesystem::path& folder, CaseParts parts);

/// Where a case's bone lies.
std::filesystem::path bone_of_case(const std::filesystem::path& folder);

/// Completes a case whose bone is there: makes a tissue of each segment that lies in the bone's box, writes
/// them on the bone's grid as the case's segmentation, chooses where the tool starts, and writes case.toml,
/// last. Segments outside are told of in `messages`. Throws std::runtime_error in one line, also where a
/// tissue that is protected or the target lies outside.
void finish_case(const std::filesystem::path& folder, const CaseParts& parts, std::ostream& messages);

}  // namespace osteomill
