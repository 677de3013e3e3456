// An image whose headers are read and whose voxels come slice by slice, of whatever format.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "common/program/progress.h"
#include "imaging/formats/source_image.h"

namespace osteomill {

/// Takes slice k of an image; the values are changed at will.
using TakeSlice = std::function<void(int k, std::span<float> values)>;

/// What an image is opened for.
enum class ImagePurpose { scan, labels };

/// What is known before the voxels are read.
struct OpenedImage {
    SourceImage image{};
    /// Values of a voxel, side by side in the slices: several of a label map in layers that overlap, as 3D
    /// Slicer writes them.
    int layers = 1;
    bool is_coloured = false;  ///< its values are colours, 0xRRGGBB, which a float holds
    /// "key:=value" of a NRRD; the segments of a DICOM segmentation in the words of Slicer's .seg.nrrd.
    std::map<std::string, std::string> key_values{};
    /// Where the values lie, where that is not the one file that was opened.
    std::vector<std::filesystem::path> data_files{};
    /// Reads the values slice by slice and hands on each, k ascending, with the file's own rescale (slice by
    /// slice in DICOM) applied. What the file says was not measured (padding) is not a number. Throws
    /// ImagingError, too, where what was compressed is damaged.
    std::function<void(const TakeSlice&, const ReportProgress&)> read_slices{};
    /// What that takes of memory at most.
    std::uint64_t reading_bytes = 0;
};

}  // namespace osteomill
