#include "render_client/volume/ct_slice.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

namespace osteomill {

namespace {

constexpr std::uint8_t half_full = 128;
constexpr std::array<std::uint8_t, 3> border_colour{255, 150, 40};

/// Index of a tissue, the number of tissues for other bone, one more for neither. A structure's mask takes
/// precedence over the bone's label.
std::size_t what_is_at(const Bone& bone, std::span<const SliceTissue> tissues, const glm::ivec3& voxel) {
    for (std::size_t i = 0; i < tissues.size(); ++i)
        if (tissues[i].mask && tissues[i].mask->contains(voxel)) return i;
    if (bone.fraction_at(voxel) < half_full) return tissues.size() + 1;
    const std::uint8_t label = tissues.empty() ? std::uint8_t{0} : bone.tissue_at(voxel);
    for (std::size_t i = 0; label != 0 && i < tissues.size(); ++i)
        if (!tissues[i].mask && tissues[i].label == label) return i;
    return tissues.size();
}

}  // namespace

glm::dvec3 SliceView::right() const {
    return plane == SlicePlane::sagittal ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(1.0, 0.0, 0.0);
}

glm::dvec3 SliceView::down() const {
    return plane == SlicePlane::axial ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(0.0, 0.0, -1.0);
}

glm::dvec3 SliceView::across() const {
    return glm::cross(right(), down());
}

glm::dvec3 SliceView::position_mm(const glm::dvec2& at) const {
    const glm::dvec2 from_middle = mm_per_px * (at - 0.5 * edge_px);
    return centre_mm + from_middle.x * right() + from_middle.y * down();
}

glm::dvec2 SliceView::pixel(const glm::dvec3& position) const {
    const glm::dvec3 from_centre = (position - centre_mm) / mm_per_px;
    return 0.5 * edge_px + glm::dvec2(glm::dot(from_centre, right()), glm::dot(from_centre, down()));
}

std::array<char, 4> edge_letters(SlicePlane plane) {
    switch (plane) {
        case SlicePlane::axial:
            return {'R', 'L', 'A', 'P'};
        case SlicePlane::coronal:
            return {'R', 'L', 'S', 'I'};
        case SlicePlane::sagittal:
            break;
    }
    return {'A', 'P', 'S', 'I'};
}

std::uint8_t HuWindow::grey(double hu) const {
    const double share = (hu - level_hu) / std::max(window_hu, 1.0) + 0.5;
    return static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(share, 0.0, 1.0)));
}

std::vector<std::uint8_t> slice_picture(const CtVolume& ct, const Bone* bone,
                                        std::span<const SliceTissue> tissues, const SliceView& view,
                                        const HuWindow& window) {
    const auto edge = static_cast<std::size_t>(view.edge_px);
    std::vector<std::uint8_t> pixels(4 * edge * edge);
    // Kind of each pixel: a tissue, by its index; other bone; neither.
    const std::size_t neither = tissues.size() + 1;
    std::vector<std::size_t> what(edge * edge, neither);
    for (std::size_t y = 0; y < edge; ++y)
        for (std::size_t x = 0; x < edge; ++x) {
            const glm::dvec3 at = view.position_mm(glm::dvec2(x, y) + 0.5);
            const std::uint8_t grey = window.grey(ct.hu_at(at));
            const std::size_t index = x + edge * y;
            std::fill_n(pixels.begin() + static_cast<std::ptrdiff_t>(4 * index), 3, grey);
            pixels[4 * index + 3] = 255;
            if (bone == nullptr) continue;
            const glm::dvec3 voxel = glm::round(to_voxel_coordinates(bone->grid(), at));
            if (glm::any(glm::greaterThan(glm::abs(voxel), glm::dvec3(1e6)))) continue;
            what[index] = what_is_at(*bone, tissues, glm::ivec3(voxel));
        }
    for (std::size_t y = 0; y + 1 < edge; ++y)
        for (std::size_t x = 0; x + 1 < edge; ++x) {
            const std::size_t index = x + edge * y;
            const std::size_t here =
                std::min({what[index], what[index + 1], what[index + edge]});  // a tissue before the bone
            if (here == what[index] && what[index] == what[index + 1] && what[index] == what[index + edge])
                continue;
            const auto& colour = here < tissues.size() ? tissues[here].colour_rgb : border_colour;
            std::copy(colour.begin(), colour.end(), pixels.begin() + static_cast<std::ptrdiff_t>(4 * index));
        }
    return pixels;
}

}  // namespace osteomill
