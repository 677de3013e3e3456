// The whole way from a scan to a bone file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <optional>
#include <string>
#include <variant>

#include "imaging/formats/image_reader.h"
#include "imaging/resampling/intensity.h"
#include "imaging/resampling/region.h"

namespace osteomill {

struct ImportOptions {
    std::filesystem::path input;
    std::filesystem::path output;
    double spacing_mm = 0.1;
    /// Whether a region that is large to drill is made coarser (usual_spacing_mm), because nobody has chosen
    /// spacing_mm.
    bool may_be_coarser = false;
    std::optional<double> threshold_hu{};
    /// Far from bone, too, HU stay as they are. Else a file with a threshold has air there (near_bone.h),
    /// which makes it some times smaller.
    bool keeps_soft_tissue = false;
    /// Parts of bone that are small and touch nothing else become air (specks.h), if there is a threshold;
    /// the scan is then refined twice. Else they are counted and stay.
    bool leaves_out_specks = false;
    /// Between slices far apart bone's contour is followed, if there is a threshold (slice_shapes.h).
    bool follows_contours = true;
    std::optional<ScanRegion> region{};
    ImageChoice choice{};
    /// The mapping from the file's values to HU (after the rescale that the file itself states).
    std::variant<std::monostate, Rescale, IntensityWindow> to_hu{};
};

/// The outputs of an import while it works, and the resources that it may use.
struct ImportSurroundings {
    std::ostream& messages;  ///< notes, memory estimate, progress
    bool is_terminal = false;
    std::optional<std::uint64_t>
        available_memory_bytes{};  ///< std::nullopt: not known, nothing is refused for it
    /// Called again and again, from any thread, while the import works; if it throws, the import ends.
    std::function<void()> go_on = [] {};
};

/// Reads the scan, cuts the region, refines it, writes the bone file. Throws ImagingError in one line: for
/// anything that image_reader.h refuses, a region outside the image, more memory than there is, a threshold
/// that no voxel reaches, an output that cannot be written. Then, and where it is made to end, nothing is
/// written.
void import_bone(const ImportOptions& options, const ImportSurroundings& surroundings);

/// The same of an image that is open already; `options.input` is for messages.
void import_bone(const ImportOptions& options, const OpenedImage& opened,
                 const ImportSurroundings& surroundings);

}  // namespace osteomill
