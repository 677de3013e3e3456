// An image as it was scanned: its own axes, spacing and range of values, before it becomes a bone's grid.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "common/program/progress.h"

namespace osteomill {

/// Voxel (i, j, k) has its centre at origin + direction * (spacing * (i, j, k)), patient LPS, mm.
struct SourceImage {
    glm::ivec3 size_voxels{0};
    glm::dvec3 spacing_mm{1.0};
    glm::dvec3 origin_mm{0.0};
    glm::dmat3 direction{1.0};  ///< columns: unit vectors of the axes i, j, k; perpendicular, either hand
    std::vector<std::string> notes{};  ///< the assumptions made, one line each
};

/// Patient LPS, mm, from continuous voxel coordinates.
inline glm::dvec3 position_mm(const SourceImage& image, const glm::dvec3& voxel) {
    return image.origin_mm + image.direction * (image.spacing_mm * voxel);
}

/// Continuous voxel coordinates from patient LPS, mm.
inline glm::dvec3 voxel_at(const SourceImage& image, const glm::dvec3& position_mm) {
    return glm::transpose(image.direction) * (position_mm - image.origin_mm) / image.spacing_mm;
}

inline std::size_t voxel_count(const SourceImage& image) {
    return static_cast<std::size_t>(image.size_voxels.x) * static_cast<std::size_t>(image.size_voxels.y) *
           static_cast<std::size_t>(image.size_voxels.z);
}

// An image whose headers are read and whose voxels come slice by slice, of whatever format.

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

// Order of the voxels of an image in memory: x fastest, then y, then z.

/// Index of a voxel in an image of `size` voxels, which holds it.
inline std::size_t voxel_index(const glm::ivec3& voxel, const glm::ivec3& size) {
    return static_cast<std::size_t>(voxel.x) +
           static_cast<std::size_t>(size.x) *
               (static_cast<std::size_t>(voxel.y) +
                static_cast<std::size_t>(size.y) * static_cast<std::size_t>(voxel.z));
}

}  // namespace osteomill
