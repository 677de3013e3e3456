#include "render_client/volume/textures/sawn_faces.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <optional>

namespace osteomill {

namespace {

constexpr int deeper = 3;                     // voxels
constexpr double least_reaching_share = 0.8;  // of the bone there, that reaches the face
constexpr double least_columns = 64.0;        // a smaller face may be a chip's
constexpr std::uint8_t solid = 128, a_quarter = 64;

/// One side of the bone. Depth counts voxels from a far outer end inwards.
struct Side {
    int axis;
    bool is_high;

    int depth_of(int voxel) const { return is_high ? -voxel : voxel; }
    int voxel_at(int depth) const { return is_high ? -depth : depth; }
};

/// The offset of a voxel in its brick: `along` the axis, and the place across it.
std::size_t offset_along(int axis, int along, int across) {
    glm::ivec3 voxel;
    voxel[axis] = along;
    voxel[(axis + 1) % 3] = across % brick_edge_voxels;
    voxel[(axis + 2) % 3] = across / brick_edge_voxels;
    return offset_in_brick(voxel);
}

constexpr int columns_of_brick = brick_edge_voxels * brick_edge_voxels;

/// Depth of the outermost voxel that is half full.
std::optional<int> outermost(const Bone& bone, const Side& side) {
    std::optional<int> found;
    for (std::size_t slot = 0; slot < bone.stored_bricks(); ++slot) {
        const BoneContent& content = bone.content();
        const int first =
            brick_edge_voxels * brick_position(content.size_bricks, content.brick_of_slot[slot])[side.axis];
        const int last = first + brick_edge_voxels - 1;
        const BrickFractions fractions = bone.fractions(static_cast<std::int32_t>(slot));
        const int outer = std::min(side.depth_of(first), side.depth_of(last));
        for (int depth = outer; depth < outer + brick_edge_voxels && (!found || depth < *found); ++depth)
            for (int column = 0; column < columns_of_brick; ++column)
                if (fractions[offset_along(side.axis, side.voxel_at(depth) - first, column)] >= solid) {
                    found = depth;
                    break;
                }
    }
    return found;
}

/// Depth of the face on that side, where it is sawn.
std::optional<double> face_of(const Bone& bone, const Side& side) {
    const std::optional<int> outer = outermost(bone, side);
    if (!outer) return std::nullopt;
    double there = 0.0, reaching = 0.0, filled = 0.0;
    const BoneContent& content = bone.content();
    const int deep_voxel = side.voxel_at(*outer + deeper);
    for (std::size_t slot = 0; slot < bone.stored_bricks(); ++slot) {
        const glm::ivec3 brick = brick_position(content.size_bricks, content.brick_of_slot[slot]);
        const int along = deep_voxel - brick_edge_voxels * brick[side.axis];
        if (along < 0 || along >= brick_edge_voxels) continue;
        const BrickFractions fractions = bone.fractions(static_cast<std::int32_t>(slot));
        for (int column = 0; column < columns_of_brick; ++column) {
            if (fractions[offset_along(side.axis, along, column)] < solid) continue;
            ++there;
            glm::ivec3 voxel = brick * brick_edge_voxels;
            voxel[(side.axis + 1) % 3] += column % brick_edge_voxels;
            voxel[(side.axis + 2) % 3] += column / brick_edge_voxels;
            const auto fraction_at = [&](int depth) {
                voxel[side.axis] = side.voxel_at(depth);
                return bone.fraction_at(voxel);
            };
            if (fraction_at(*outer) < a_quarter) continue;
            ++reaching;
            for (int depth = *outer - 1; depth < *outer + deeper; ++depth)
                filled += fraction_at(depth) / 255.0;
        }
    }
    if (there < least_columns || reaching < least_reaching_share * there) return std::nullopt;
    return *outer + deeper - filled / reaching;
}

}  // namespace

bool SawnFaces::any() const {
    return glm::any(glm::greaterThan(low, glm::dvec3(-none))) ||
           glm::any(glm::lessThan(high, glm::dvec3(none)));
}

void find_sawn_faces(const Bone& bone, int axis, SawnFaces& faces) {
    if (const auto depth = face_of(bone, {axis, false})) faces.low[axis] = *depth;
    // A voxel's outer side is one further on there.
    if (const auto depth = face_of(bone, {axis, true})) faces.high[axis] = 1.0 - *depth;
}

SawnFaces sawn_faces(const Bone& bone) {
    SawnFaces faces;
    for (int axis = 0; axis < 3; ++axis) find_sawn_faces(bone, axis, faces);
    return faces;
}

}  // namespace osteomill
