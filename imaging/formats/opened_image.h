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

/// The purpose for which an image is opened.
enum class ImagePurpose { scan, labels };

/// An image's facts that are known before its voxels are read.
struct OpenedImage {
    SourceImage image{};
    /// Values of a voxel, side by side in the slices: several of a label map in layers that overlap, as 3D
    /// Slicer writes them.
    int layers = 1;
    bool is_coloured = false;  ///< its values are colours, 0xRRGGBB, which a float holds
    /// "key:=value" of a NRRD; the segments of a DICOM segmentation as in Slicer's .seg.nrrd.
    std::map<std::string, std::string> key_values{};
    /// The files that hold the values, if that is not the one file that was opened.
    std::vector<std::filesystem::path> data_files{};
    /// Reads the values slice by slice and hands on each, k ascending, with the file's own rescale (slice by
    /// slice in DICOM) applied. Values that the file marks as not measured (padding) are not a number. Throws
    /// ImagingError, also for damaged compressed data.
    std::function<void(const TakeSlice&, const ReportProgress&)> read_slices{};
    /// The most memory that read_slices takes.
    std::uint64_t reading_bytes = 0;
};

}  // namespace osteomill
