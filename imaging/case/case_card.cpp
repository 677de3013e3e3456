#include "imaging/case/case_card.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <span>
#include <variant>

#include "imaging/picture/bone_picture.h"

namespace osteomill {

namespace {

constexpr glm::ivec2 size_px(240, 160);
constexpr double margin = 1.08;
/// Background of the built-in cases' cards: the window's dark theme.
constexpr std::array background{glm::dvec3(98.0, 103.0, 110.0), glm::dvec3(61.0, 65.0, 69.0)};

struct Box {
    glm::dvec3 low_mm{std::numeric_limits<double>::infinity()};
    glm::dvec3 high_mm{-std::numeric_limits<double>::infinity()};
};

/// Box of the bricks with bone.
Box box_of(const Bone& bone) {
    Box box;
    const BoneContent& content = bone.content();
    for (std::size_t slot = 0; slot < bone.stored_bricks(); ++slot) {
        const glm::ivec3 first =
            brick_edge_voxels * brick_position(content.size_bricks, content.brick_of_slot[slot]);
        const glm::ivec3 last = glm::min(first + brick_edge_voxels, bone.grid().size_voxels) - 1;
        box.low_mm = glm::min(box.low_mm, centre_of_voxel_mm(bone.grid(), first));
        box.high_mm = glm::max(box.high_mm, centre_of_voxel_mm(bone.grid(), last));
    }
    return box;
}

/// Unit vector to the viewer: between the tool's side and the front, from above.
glm::dvec3 to_eye_of(const Scene& scene) {
    const glm::dvec3 from_front = glm::normalize(glm::dvec3(-0.25, -0.7, 0.7));
    const glm::dvec3 half_way = from_front + scene.start_pose.spindle_axis;
    return glm::length(half_way) > 0.1 ? glm::normalize(half_way) : from_front;
}

/// Head up, unless the view is along it.
BoneView view_of(const Scene& scene, const Bone& bone) {
    const Box box = box_of(bone);
    BoneView view{.centre_mm = 0.5 * (box.low_mm + box.high_mm),
                  .direction = -to_eye_of(scene),
                  .background = background};
    const glm::dvec3 wanted =
        std::abs(view.direction.z) > 0.95 ? glm::dvec3(0, -1.0, 0) : glm::dvec3(0, 0, 1.0);
    const glm::dvec3 right = glm::normalize(glm::cross(view.direction, wanted));
    view.up = glm::cross(right, view.direction);
    const glm::dvec3 half_mm = 0.5 * (box.high_mm - box.low_mm);
    const double aspect = static_cast<double>(size_px.x) / size_px.y;
    view.half_width_mm =
        margin * std::max(glm::dot(half_mm, glm::abs(right)), aspect * glm::dot(half_mm, glm::abs(view.up)));
    return view;
}

}  // namespace

std::string sentence_about(const Scene& scene, const Bone& bone) {
    const Grid& grid = bone.grid();
    const glm::dvec3 size_mm = grid.spacing_mm * glm::dvec3(grid.size_voxels);
    std::string sentence = fmt::format("{:.0f} x {:.0f} x {:.0f} mm in voxels of {:.3g} mm", size_mm.x,
                                       size_mm.y, size_mm.z, grid.spacing_mm);
    if (scene.plan)
        if (const auto* region = std::get_if<TissueRegion>(&scene.plan->region))
            sentence += "; to be removed: " + region->tissue;
    return sentence + '.';
}

void write_card_picture(const Scene& scene, const Bone& bone, const std::filesystem::path& png) {
    const RgbPicture square = picture_of(bone, scene.tissues, view_of(scene, bone), size_px.x);
    const std::size_t row_bytes = 3 * static_cast<std::size_t>(size_px.x);
    const auto above = static_cast<std::size_t>((size_px.x - size_px.y) / 2);
    write_lasting_png(
        std::span(square.rgb).subspan(above * row_bytes, static_cast<std::size_t>(size_px.y) * row_bytes),
        size_px, png, Link::replace);
}

}  // namespace osteomill
