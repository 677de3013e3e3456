// A case: a folder with what a session needs of one patient. Its case.toml is a scene file; beside it lie
// bone.nrrd, a picture of it for people and, where there is one, the segmentation on the bone's grid.
#pragma once

#include <array>
#include <filesystem>
#include <iosfwd>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/scene/pass_marks.h"
#include "imaging/formats/image_reader.h"
#include "imaging/segmentation/segmentation.h"

namespace osteomill {

/// What --scene takes for a case: the name of one that is built in, or a folder's case.toml. Throws
/// std::invalid_argument, with those built in and the nearest name, for what is neither.
std::string scene_of_case(const std::string& name);

/// The folder's own name, for people. Throws std::invalid_argument where that is no plain text
/// (plain_text.h).
std::string name_of_case(const std::filesystem::path& folder);

/// What a case is made of beside its scan. A folder stands for the label maps in it.
struct CaseParts {
    std::vector<std::filesystem::path> labels{};  ///< that bone is made of, without a scan; tissues, too
    std::vector<std::filesystem::path> segmentations{};  ///< all their segments become tissues
    std::optional<std::filesystem::path> colours{};  ///< names and colours of those that are plain label maps
    std::optional<glm::dvec3> stack_spacing_mm{};    ///< of label maps that are a stack of pictures
    std::vector<std::string> is_protected{};         ///< tissues, by name
    double warn_mm = 1.0;                            ///< of those: from what distance on
    std::map<std::string, double> warns_from_mm{};   ///< by name, of those with a distance of their own
    std::optional<std::string> target{};             ///< the tissue that is to be removed
    /// What tissues are made of, by name, or soft_material (material.h). Of labels that bone is made of,
    /// others are what their names say; of a scan, what its CT numbers say.
    std::map<std::string, std::string> materials{};
    std::string description{};  ///< a sentence for people; empty: one about its bone
    PassMarks pass{};           ///< what a session has to reach
};

/// A case for which bone is yet to be made.
struct BegunCase {
    CaseParts parts;  ///< names as the segmentations spell them: blanks and underscores are alike
    std::vector<std::shared_ptr<const Segmentation>> segmentations{};  ///< those of `labels` first
    std::size_t labels = 0;                                            ///< so many of them
};

/// Reads the segmentations. Throws std::runtime_error where one or the colours cannot be read, or a name that
/// is protected, the target or of a material is none of theirs, or a material is none.
BegunCase read_case_parts(CaseParts parts);

/// Makes the folder. Throws std::runtime_error where it holds a case already or cannot be made.
void begin_case(const std::filesystem::path& folder);

/// Of a case that is being made: removes again what was not there before, unless it is finished.
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

/// Of a case without a scan: the CT numbers of its bone (bone_of_labels.h). Says which segments are bone. To
/// look at, all are where none is.
OpenedImage scan_of_labels(const BegunCase& begun, std::ostream& messages, bool is_to_look_at = false);

/// All that is made in a case's folder, whether it is there or not.
std::vector<std::filesystem::path> files_of_case(const std::filesystem::path& folder);

/// Where a case's bone lies.
std::filesystem::path bone_of_case(const std::filesystem::path& folder);

/// Completes a case whose bone is there: makes a tissue of each segment that lies in the bone's box, writes
/// them on the bone's grid as the case's segmentation, chooses where the tool starts, draws its picture and
/// writes case.toml, last. Segments outside are named in `messages`. Throws std::runtime_error in one line,
/// also where a tissue that is protected or the target lies outside. `go_on`: see ImportSurroundings.
void finish_case(
    const std::filesystem::path& folder, const BegunCase& begun, std::ostream& messages,
    const std::function<void()>& go_on = [] {});

}  // namespace osteomill
