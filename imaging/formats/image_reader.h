// Opens an image of any kind that is read, scan or labels: a DICOM folder or file, NRRD, NIfTI, MetaImage or
// a stack of pictures, by what it holds.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "imaging/formats/source_image.h"
#include "imaging/progress.h"

namespace osteomill {

/// Takes slice k of an image; the values are changed at will.
using TakeSlice = std::function<void(int k, std::span<float> values)>;

/// What is known before the voxels are read.
struct OpenedImage {
    SourceImage image{};  ///< without values
    /// Values of a voxel, side by side in the slices: several of a label map in layers that overlap, as 3D
    /// Slicer writes them.
    int layers = 1;
    bool is_coloured = false;  ///< its values are colours, 0xRRGGBB, which a float holds
    /// "key:=value" of a NRRD; the segments of a DICOM segmentation in the words of Slicer's .seg.nrrd.
    std::map<std::string, std::string> key_values{};
    /// Reads the values slice by slice and hands on each, k ascending, with the file's own rescale (slice by
    /// slice in DICOM) applied. What the file says was not measured (padding) is not a number. Throws
    /// ImagingError, too, where what was compressed is damaged.
    std::function<void(const TakeSlice&, const ReportProgress&)> read_slices{};
    /// What that takes of memory at most.
    std::uint64_t reading_bytes = 0;

    /// All of them, as image.values has them.
    std::vector<float> read_values(const ReportProgress& report) const;
};

/// What somebody says of an image beside its path.
struct ImageChoice {
    std::optional<std::string> series_uid{};       ///< of a DICOM folder; the largest series otherwise
    std::optional<glm::dvec3> stack_spacing_mm{};  ///< of a stack of pictures, which do not say it themselves
};

/// Reads headers only. Throws ImagingError, in one line, for all that is no three-dimensional grey image
/// placed in the patient: a path that does not exist, an unknown kind of file, a header that is cut off or
/// says what cannot be, 2 or 4 dimensions, a single slice, colour, a geometry that no scan has
/// (plausible_geometry.h), voxels for which the files are too short, and what the headers, dicom_series.h,
/// slice_geometry.h and picture_stack.h refuse.
OpenedImage open_image(const std::filesystem::path& path, const ImageChoice& choice = {});

/// Whether the name is one of an image's file, by its ending; DICOM's files have none of their own.
bool is_image_name(const std::filesystem::path& path);

/// The file's name without what tells its format: "mandible" of "mandible.seg.nrrd".
std::string name_without_ending(const std::filesystem::path& path);

/// As open_image, of a label map, which may have layers or colours: in any of the formats, and a DICOM
/// segmentation.
OpenedImage open_labels(const std::filesystem::path& path, const ImageChoice& choice = {});

}  // namespace osteomill
