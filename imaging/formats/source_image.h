// An image as it was scanned: its own axes, spacing and range of values, before it becomes a bone's grid.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

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

}  // namespace osteomill
