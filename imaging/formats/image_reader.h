// Reader of images of every format, scan or labels: a DICOM folder or file, NRRD, NIfTI, MetaImage or a stack
// of pictures, recognised by its contents.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "imaging/formats/image_file.h"
#include "imaging/formats/source_image.h"
#include "imaging/formats/voxel_data.h"

namespace osteomill {

/// A user's choices about an image beside its path.
struct ImageChoice {
    std::optional<std::string> series_uid{};       ///< for a DICOM folder; the largest series otherwise
    std::optional<glm::dvec3> stack_spacing_mm{};  ///< for a stack of pictures, which do not state it
                                                   ///< themselves
};

/// Reads headers only. Throws ImagingError, in one line, for all that is no three-dimensional grey image
/// placed in the patient: a path that does not exist, an unknown kind of file, a header that is cut off or
/// impossible, 2 or 4 dimensions, a single slice, colour, a geometry that no scan has (plausible_geometry.h),
/// voxels for which the files are too short, and anything that the headers, dicom_series.h, slice_stack.h
/// and picture_stack.h refuse.
OpenedImage open_image(const std::filesystem::path& path, const ImageChoice& choice = {});

/// Whether the name is one of an image's file, by its ending; DICOM's files have none of their own.
bool is_image_name(const std::filesystem::path& path);

/// The file's name without its format's ending: "mandible" of "mandible.seg.nrrd".
std::string name_without_ending(const std::filesystem::path& path);

/// The files that reading an image or a label map opens: the path itself, and the files that its header
/// names. A folder stands for all that is in it.
std::vector<std::filesystem::path> files_of_image(const std::filesystem::path& path);

/// Opens a label map as open_image does an image: in any of the formats, with layers or colours, or as a
/// DICOM segmentation.
OpenedImage open_labels(const std::filesystem::path& path, const ImageChoice& choice = {});

// The values of an image from the bytes of its files, slice by slice: no more than a slice is held.

/// Reads `data` and hands on the slices of an image of that size, as they come. Throws ImagingError as
/// read_voxel_data does, and for text that holds something else than numbers, or too few.
void read_value_slices(const VoxelData& data, const VoxelLayout& layout, const glm::ivec3& size_voxels,
                       const TakeSlice& take, const ReportProgress& report);

}  // namespace osteomill
