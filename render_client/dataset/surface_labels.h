// Labels of a picture's pixels: tools, the tissues of the bone, soft structures.
//
// The tissue of a point of bone's surface is the one that has most of the eight voxels about the point, each
// weighted as in trilinear interpolation. Voxels that are less than half full lie outside the surface, where
// segmentations and phantoms label loosely: they count only if there is no other.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "common/bone/bone.h"
#include "common/scene/scene.h"
#include "render_client/volume/camera.h"
#include "render_client/volume/passes/surface_pass.h"

namespace osteomill {

/// The table of labels: place i is label i.
struct SurfaceLabel {
    std::string name{};
    std::array<std::uint8_t, 3> colour_rgb{};
};

/// nothing, burr, shank, bone of no tissue, and then a session's tissues in its order; an image can tell 252
/// apart, and further ones count as no tissue.
std::vector<SurfaceLabel> label_table(std::span<const Tissue> tissues);
/// The label of a session's tissue, by its place among them.
std::uint8_t label_of_tissue(std::size_t tissue);

/// Tissue label of a bone's surface at a point; 0 if no tissue is known. Tissues that `is_hidden` have no
/// part.
std::uint8_t tissue_of_surface(const Bone& bone, const glm::dvec3& position_mm,
                               const std::array<bool, 256>& is_hidden = {});

/// The label of every pixel. For pixels that the image marks as bone, the tissue is read from `bone` where
/// the camera's rays ended.
std::vector<std::uint8_t> surface_labels(const SurfaceImage& image, const Camera& camera, const Bone& bone,
                                         std::span<const Tissue> tissues);

}  // namespace osteomill
