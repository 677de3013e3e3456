// Surface voxels, shaded one by one as the published system did it.
//
// A voxel is inside where at least half of it is bone. An inside voxel with at least one of its 26 neighbours
// outside is a surface voxel. Its normal is the normalised sum over those neighbours of the direction to
// them, weighted by the gradient along it: the difference of the fractions over the distance. Its colour is
// Phong's without the specular part, under the lights of lighting.h. Points outside the bone's grid are
// outside.
//
// Which voxels are outside is a bit each, a row of 62 and its borders in a word: surface voxels are found a
// row at a time, and the directions to outside neighbours are summed by looking up nine bits a layer.
#pragma once

#include <array>
#include <cstdint>
#include <glm/ext/vector_int3_sized.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "render_client/volume/shading_settings.h"
#include "render_client/volume/textures/light_table.h"

namespace osteomill {

/// A texel: display RGB times alpha, and alpha, which is 255 for a surface voxel and 0 for any other. So
/// interpolated colour over interpolated alpha is the mean colour of the surface voxels nearby.
struct SurfaceTexel {
    std::uint8_t r = 0, g = 0, b = 0, a = 0;

    bool operator==(const SurfaceTexel&) const = default;
};

class SurfaceShader {
  public:
    explicit SurfaceShader(const LookTable& table);

    /// Texels of a box of the bone's grid, x fastest. Valid until the next call.
    const std::vector<SurfaceTexel>& shade(const Bone& bone, const VoxelBox& box);

  private:
    /// Of the box: columns first_x to first_x + columns, at most 62.
    void shade_columns(const glm::ivec3& size, int first_x, int columns);
    /// Six times the sum that the normal is along, of the voxel at a bit (counted from the border) of a row.
    glm::ivec3 outward(const std::uint8_t* own, std::size_t row, int bit) const;
    SurfaceTexel texel(const glm::ivec3& outward, std::uint8_t code) const;

    std::optional<BoneChannel> channel_;
    std::array<glm::vec3, 256> display_by_code_{};  ///< colours, 0 to 255
    LightTable light_;
    /// To neighbours: the direction over the distance, times six, which makes all of them whole.
    std::array<glm::ivec3, 27> directions_{};
    /// Their sum, by layer (z one below, the same, one above) and by which of its 3 x 3 voxels are outside.
    std::array<std::array<glm::i8vec3, 512>, 3> directions_of_layer_{};

    // Of the call under way, of the box and a border of one voxel.
    std::vector<std::uint8_t> fraction_;
    std::vector<std::uint8_t> code_;      ///< of the box alone
    std::vector<std::uint64_t> outside_;  ///< by row: less than half full
    std::vector<std::uint64_t> partial_;  ///< by row: outside, and yet not empty
    std::size_t rows_per_layer_ = 0;
    std::array<std::ptrdiff_t, 27> offsets_{};  ///< to neighbours, in fraction_
    std::vector<SurfaceTexel> texels_;
};

}  // namespace osteomill
