// A picture of a bone by the CPU: parallel rays through its bricks to where half a voxel is left; and PNGs of
// such pictures.
//
// Surface and normals are those of the window (bone_sampling.glsl). Lit from the viewer's upper left,
// coloured by tissue; where the near side is cut away, the cut face is flat and bears the tissues' colours.
// On it borders of tissues and structures are smooth (smooth_border.h), unless a voxel is hardly larger than
// a pixel. An import and a server have no OpenGL, and a case or a page of a report needs some pictures, not
// thirty a second.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

#include "common/bone/bone.h"
#include "common/bone/structure_mask.h"
#include "common/files/atomic_file.h"
#include "common/scene/scene.h"

namespace osteomill {

/// Patient LPS.
struct BoneView {
    glm::dvec3 centre_mm{0.0};         ///< in the middle of the picture
    glm::dvec3 direction{0, 0, -1.0};  ///< unit, from the viewer
    glm::dvec3 up{0, -1.0, 0};         ///< unit, square to the direction
    double half_width_mm = 10.0;
    bool is_section = false;  ///< all before the centre is cut away
    /// Colours beside the bone, sRGB from 0 to 255: at the picture's upper edge, and at its lower one.
    std::array<glm::dvec3, 2> background{glm::dvec3(255.0), glm::dvec3(255.0)};
};

struct RgbPicture {
    int size_px = 0;  ///< square
    std::vector<std::uint8_t> rgb{};
};

/// Marks that a section shows besides bone.
struct SectionMarks {
    std::span<const Structure> structures{};                        ///< in their tissue's colour
    std::function<bool(const glm::dvec3& place_mm)> is_outlined{};  ///< a region whose border is drawn
    /// Or one of voxels, some of them beyond the grid, whose border is drawn smooth.
    std::function<bool(const glm::ivec3& voxel)> is_outlined_voxel{};
};

RgbPicture picture_of(const Bone& bone, std::span<const Tissue> tissues, const BoneView& view, int size_px,
                      const SectionMarks& marks = {});

// A picture as a PNG that lasts: small, and on the disk when it is written. The window's, of which there are
// thirty a second, are those of render_client/volume/picture.h.

/// The bytes of a PNG. `rgb`: three bytes a pixel, rows from above. Throws std::runtime_error.
std::string lasting_png(std::span<const std::uint8_t> rgb, const glm::ivec2& size_px);

/// Replaces the file as a whole. Throws std::runtime_error, in one line naming the file, if it cannot be
/// written.
void write_lasting_png(std::span<const std::uint8_t> rgb, const glm::ivec2& size_px,
                       const std::filesystem::path& path, Link link = Link::follow);

}  // namespace osteomill
