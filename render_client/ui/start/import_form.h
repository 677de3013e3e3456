// Form that a person fills in to make a case of a scan, and the commands that follow from it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/scene/rating.h"
#include "common/scene/tissue_tables.h"
#include "render_client/ui/start/shown_scan.h"

namespace osteomill {

struct SegmentChoice {
    std::string name;
    bool is_protected = false;
    double warn_mm = usual_warn_mm(true);  ///< where it is protected
    bool is_target = false;                ///< true for one at most
    std::string material{};                ///< empty: by its CT numbers; for labels, by its name

    bool operator==(const SegmentChoice&) const = default;
};

struct ImportForm {
    std::filesystem::path scan{};
    bool are_labels = false;  ///< the scan is a label map, and its bone becomes the bone
    std::vector<std::filesystem::path> segmentations{};
    std::optional<std::filesystem::path> colours{};  ///< a table of label maps' names and colours
    std::string stack_spacing{};  ///< "x,y,z", mm, of a stack of pictures; empty if there is none
    std::vector<SegmentChoice> segments{};
    ScanBox region{};
    double threshold_hu = 300.0;
    double spacing_mm = 0.1;
    bool is_spacing_chosen = false;     ///< by a person; else it follows the region
    std::uint64_t available_bytes = 0;  ///< this machine's memory; 0: not known
    bool keeps_soft_tissue = true;      ///< for people who view the CT in the window
    bool leaves_out_specks = false;     ///< small parts of bone that touch nothing else become air
    std::string name{};
    std::string description{};  ///< empty: a sentence about its bone
    PassMarks pass{};           ///< as chosen; kept while no segment is a target or protected

    bool operator==(const ImportForm&) const = default;
};

/// Whether a mark of the metric could be missed: those of the plan need a target, touches a protected
/// segment.
bool takes_mark(const ImportForm& form, const PassMarkKind& kind);

/// A bone of more voxels is refused, before an hour is spent on it.
inline constexpr double most_imported_voxels = 1.5e9;
/// The edge of the preview's voxels and pixels.
inline constexpr double preview_mm_per_px = 0.5;

/// Edges that a voxel may have.
inline constexpr double finest_voxel_mm = 0.02;
inline constexpr double coarsest_voxel_mm = 10.0;

double voxels_of(const ImportForm& form);
/// Says that its bone would have too many voxels, and what to do; empty if it has not.
std::string wrong_with_size(const ImportForm& form);
/// Says that no voxel of the scan can reach the threshold; empty if one may, and of labels.
std::string wrong_with_threshold(const ImportForm& form, const ScanPreview& look);
/// The bone's memory if all of the region were bone.
double most_memory_bytes(const ImportForm& form);

/// Measured on a computer with two cores: docs/cases.md's import by command, 401^3 voxels with the soft
/// tissue, takes 4 s there.
inline constexpr double imported_voxels_per_s = 1.6e7;

/// An estimate of the import's time: the time of the preview less that of its own voxels, and then so many
/// voxels a second.
double estimated_s(const ImportForm& form, const ScanPreview& look);

/// bone_import, as a path, with the options of a preview of the scan and the segmentations.
std::vector<std::string> look_command(const std::string& bone_import, const ImportForm& form,
                                      const std::filesystem::path& voxels);
/// The command that makes a case of it in `folder`.
std::vector<std::string> import_command(const std::string& bone_import, const ImportForm& form,
                                        const std::filesystem::path& folder);

/// A line of bone_import with the names of the form's fields in place of its options.
std::string without_options(std::string line);

/// The words of bone_import about small parts of bone that touch nothing else, in the window's language and
/// without its options; empty if it said none.
std::string specks_said(const std::string& said);

/// Edge of a voxel if nobody has chosen one: 0.1 mm, of a finer scan its own, 0.02 mm at least, or longer
/// (grid.h).
double default_spacing_mm(const ImportForm& form, const ScanPreview& look);

/// Takes the result of a preview. Segments that the form knows keep their settings. For another scan the
/// region becomes all of it, in voxels of the default size.
void take_look(ImportForm& form, const ScanPreview& look, bool is_another_scan);

}  // namespace osteomill
