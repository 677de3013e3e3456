// The picture that render_client would draw if time were no object: rays in steps of a tenth of a voxel in
// double precision on the CPU, no skipping, no texture units. The model is that of the shaders: the surface
// of bone, its colours and opacities, the lights, the background. This picture is the exact form of the
// shaders' approximation; parts of the model (ambient occlusion from a coarse map, surface voxels) come from
// the same bytes.
#pragma once

#include <array>
#include <limits>
#include <span>
#include <vector>

#include "render_client/volume/camera.h"
#include "render_client/volume/picture.h"
#include "render_client/volume/shading_settings.h"
#include "render_client/volume/textures/empty_space.h"
#include "render_client/volume/textures/surface_voxels.h"

namespace osteomill::study {

// A bone as the reference image sees it: every voxel in memory, everything between voxels in double
// precision. All functions take points in voxels of the box's texture coordinates, as the shaders do.

/// Trilinear interpolation within one cell between eight voxel centres, kept while a ray stays in it.
struct Cell {
    glm::ivec3 low{std::numeric_limits<int>::min()};  ///< the first of its eight voxels
    std::array<double, 8> values{};                   ///< x fastest
    bool is_empty = true;
};

class ReferenceVolume {
  public:
    /// The look as render_client would show it. Takes a dense copy of the stored box: a byte a voxel, one
    /// smoothed, one where bone has codes, four with surface voxels. Throws std::runtime_error for a bone
    /// without bricks.
    ReferenceVolume(const Bone& bone, std::span<const TissueColour> tissues, const ShadingSettings& look);

    const VoxelBox& box() const { return box_; }
    const Grid& grid() const { return grid_; }
    bool is_translucent() const { return table_.mode == TransferMode::translucent; }
    bool has_surface_colours() const { return !surface_.empty(); }

    /// Fraction, 0 to 1. `cell` may be of any point; it becomes that of this one.
    double fraction_at(const glm::dvec3& point, Cell& cell) const;
    double fraction_at(const glm::dvec3& point) const;
    /// The shaders' estimate: differences of the smoothed fractions over eight corners of a cube round the
    /// point.
    glm::dvec3 eight_corner_gradient_at(const glm::dvec3& point) const;
    /// Linear RGB and opacity, blended from the eight nearest voxels that are shown.
    glm::dvec4 look_at(const glm::dvec3& point) const;
    /// The same from the 27 nearest, by the quadratic B-spline, or, for tissues, from the 4^3 nearest.
    glm::dvec4 smooth_look_at(const glm::dvec3& point) const;
    glm::dvec4 look_under(const glm::dvec3& point, const glm::dvec3& normal) const;
    /// Display RGB times alpha, and alpha, of surface voxels.
    glm::dvec4 surface_colour_at(const glm::dvec3& point) const;
    /// How much of the sky above a surface is free of bone, as the shaders estimate it.
    double ambient_occlusion(const glm::dvec3& point, const glm::dvec3& normal) const;

  private:
    glm::dvec4 wide_look_at(const glm::dvec3& point) const;
    double smoothed_at(const glm::dvec3& point) const;
    double mean_fraction_at(const glm::dvec3& point) const;
    std::uint8_t code_at(const glm::ivec3& voxel) const;
    bool contains(const glm::ivec3& voxel) const;
    std::size_t place(const glm::ivec3& voxel) const {
        return (static_cast<std::size_t>(voxel.z) * box_.size.y + voxel.y) * box_.size.x + voxel.x;
    }

    Grid grid_;
    VoxelBox box_;
    TransferTable table_;
    glm::ivec3 mean_size_{0};
    std::vector<std::uint8_t> fraction_{};
    std::vector<std::uint8_t> smoothed_{};  ///< the shaders' own bytes
    std::vector<std::uint8_t> code_{};
    std::vector<std::uint8_t> mean_fraction_{};
    std::vector<SurfaceTexel> surface_{};
};

struct ReferenceSettings {
    double step_voxels = 0.1;
    unsigned threads = 2;  ///< at least 1
};

Picture reference_image(const ReferenceVolume& volume, const Camera& camera, const glm::ivec2& size_px,
                        const ReferenceSettings& settings = {});

}  // namespace osteomill::study
