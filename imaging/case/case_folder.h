// A case: a folder with one patient's data for sessions. Its case.toml is a scene file; beside it lie
// bone.nrrd, a picture of the bone and, if there is one, the segmentation on the bone's grid.
#pragma once

#include <array>
#include <filesystem>
#include <iosfwd>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/scene/rating.h"
#include "imaging/formats/image_reader.h"
#include "imaging/segmentation/segmentation.h"

namespace osteomill {

/// Scene file of a case as --scene names it: by the name of a built-in one, or as a folder's case.toml.
/// Throws std::invalid_argument for anything else, with the built-in ones and the nearest name.
std::string scene_of_case(const std::string& name);

/// The folder's own name, for people. Throws std::invalid_argument if that is no plain text (foreign_text.h).
std::string name_of_case(const std::filesystem::path& folder);

/// Parts of a case besides its scan. A folder stands for the label maps in it.
struct CaseParts {
    std::vector<std::filesystem::path> labels{};  ///< that bone is made of, without a scan; tissues, too
    std::vector<std::filesystem::path> segmentations{};  ///< all their segments become tissues
    std::optional<std::filesystem::path> colours{};  ///< names and colours of those that are plain label maps
    std::optional<glm::dvec3> stack_spacing_mm{};    ///< of label maps that are a stack of pictures
    std::vector<std::string> is_protected{};         ///< tissues, by name
    double warn_mm = 1.0;                            ///< of those: the distance of warning
    std::map<std::string, double> warns_from_mm{};   ///< by name, of those with a distance of their own
    std::optional<std::string> target{};             ///< the tissue that is to be removed
    /// Materials of tissues by name, or soft_material (material.h). Others are of the material that their
    /// name implies, if bone is made of labels; in a scan their CT numbers decide.
    std::map<std::string, std::string> materials{};
    std::string description{};  ///< a sentence for people; empty: one about its bone
    PassMarks pass{};           ///< marks that a session has to reach
};

/// A case for which bone is yet to be made.
struct BegunCase {
    CaseParts parts;  ///< names as the segmentations spell them: blanks and underscores are alike
    std::vector<std::shared_ptr<const Segmentation>> segmentations{};  ///< those of `labels` first
    std::size_t labels = 0;                                            ///< so many of them
};

/// Reads the segmentations. Throws std::runtime_error if one of them or the colours cannot be read, if a name
/// given as protected, as the target or with a material is none of theirs, or if a material is unknown.
BegunCase read_case_parts(CaseParts parts);

/// Makes the folder. Throws std::runtime_error if it holds a case already or cannot be made.
void begin_case(const std::filesystem::path& folder);

/// Guard of a case that is being made: unless it is finished, it removes all that was not there before.
class UnfinishedCase {
  public:
    /// To be made before begin_case.
    explicit UnfinishedCase(const std::filesystem::path& folder);
    ~UnfinishedCase();
    UnfinishedCase(const UnfinishedCase&) = delete;
    UnfinishedCase& operator=(const UnfinishedCase&) = delete;

    void finish() { made_.clear(); }

  private:
    std::vector<std::filesystem::path> made_{};  // the folder last
};

/// For a case without a scan: the CT numbers of its bone (bone_of_labels.h). Prints which segments are bone.
/// For a preview all are, if none is.
OpenedImage scan_of_labels(const BegunCase& begun, std::ostream& messages, bool is_to_look_at = false);

/// All files that are made in a case's folder, whether they exist or not.
std::vector<std::filesystem::path> files_of_case(const std::filesystem::path& folder);

/// The file of a case's bone.
std::filesystem::path bone_of_case(const std::filesystem::path& folder);

/// Completes a case whose bone is there: makes a tissue of each segment in the bone's box, writes them on the
/// bone's grid as the case's segmentation, chooses the tool's start, draws the picture and, last, writes
/// case.toml. `messages` names the segments outside. Throws std::runtime_error in one line, also if a
/// protected tissue or the target lies outside. `go_on`: see ImportSurroundings.
void finish_case(
    const std::filesystem::path& folder, const BegunCase& begun, std::ostream& messages,
    const std::function<void()>& go_on = [] {});

}  // namespace osteomill
