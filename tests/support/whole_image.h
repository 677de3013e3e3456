// An image with all of its voxels, for tests: the product has them slice by slice.
#pragma once

#include <vector>

#include "imaging/formats/source_image.h"
#include "imaging/resampling/region.h"

namespace osteomill {

struct WholeImage : SourceImage {
    std::vector<float> values{};  ///< i fastest
};

inline std::vector<float> values_of(const OpenedImage& opened) {
    std::vector<float> values;
    opened.read_slices(
        [&](int, std::span<float> slice) { values.insert(values.end(), slice.begin(), slice.end()); },
        [](double) {});
    return values;
}

/// The part with the voxels of the box.
inline WholeImage cut(const WholeImage& image, const ImageBox& box) {
    WholeImage part{part_of(image, box)};
    part.values.resize(voxel_count(part));
    const auto slice =
        static_cast<std::size_t>(image.size_voxels.x) * static_cast<std::size_t>(image.size_voxels.y);
    for (int k = box.first.z; k <= box.last.z; ++k)
        put_slice(image, box, k, std::span(image.values).subspan(static_cast<std::size_t>(k) * slice, slice),
                  part.values);
    return part;
}

}  // namespace osteomill
