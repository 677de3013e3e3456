#include "render_client/volume/surface_voxels.h"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "render_client/volume/lighting.h"

namespace osteomill {

namespace {

constexpr std::uint8_t half_full = 128;

/// One of the 26 neighbours of a voxel, in a dense box of voxels.
struct Neighbour {
    std::ptrdiff_t offset;
    glm::dvec3 direction_per_distance;  ///< unit direction over the distance to it, voxels
};

std::array<Neighbour, 26> neighbours_in(const glm::ivec3& size) {
    std::array<Neighbour, 26> neighbours{};
    std::size_t count = 0;
    for (int z = -1; z <= 1; ++z)
        for (int y = -1; y <= 1; ++y)
            for (int x = -1; x <= 1; ++x) {
                if (x == 0 && y == 0 && z == 0) continue;
                const glm::dvec3 step(x, y, z);
                neighbours[count++] = {(static_cast<std::ptrdiff_t>(z) * size.y + y) * size.x + x,
                                       step / glm::dot(step, step)};
            }
    return neighbours;
}

SurfaceTexel texel_of(const glm::dvec3& display_rgb) {
    const auto byte = [](double value) { return static_cast<std::uint8_t>(std::lround(255.0 * value)); };
    return {byte(display_rgb.r), byte(display_rgb.g), byte(display_rgb.b), 255};
}

}  // namespace

std::vector<SurfaceTexel> shade_surface_voxels(const Bone& bone, const LookTable& table,
                                               const VoxelBox& box) {
    const VoxelBox bordered{box.first - 1, box.size + 2};
    std::vector<std::uint8_t> fraction(bordered.count());
    copy_channel(bone, BoneChannel::fraction, bordered, fraction);
    std::vector<std::uint8_t> code(table.channel ? box.count() : 0);
    if (table.channel) copy_channel(bone, *table.channel, box, code);

    const auto neighbours = neighbours_in(bordered.size);
    std::vector<SurfaceTexel> texels(box.count());
    std::size_t place = 0;
    for (int z = 0; z < box.size.z; ++z)
        for (int y = 0; y < box.size.y; ++y)
            for (int x = 0; x < box.size.x; ++x, ++place) {
                const std::uint8_t* const own =
                    fraction.data() +
                    (static_cast<std::size_t>(z + 1) * bordered.size.y + y + 1) * bordered.size.x + x + 1;
                if (*own < half_full) continue;
                glm::dvec3 outward(0.0);
                bool on_surface = false;
                for (const Neighbour& neighbour : neighbours) {
                    const std::uint8_t other = own[neighbour.offset];
                    if (other >= half_full) continue;
                    on_surface = true;
                    outward += static_cast<double>(*own - other) * neighbour.direction_per_distance;
                }
                if (!on_surface) continue;
                const double length = glm::length(outward);
                // A single voxel in empty space looks to all sides: it is lit from above.
                const glm::dvec3 normal = length > 1e-6 ? outward / length : glm::dvec3(0.0, 0.0, 1.0);
                const glm::dvec3 colour(table.by_code[code.empty() ? 0 : code[place]]);
                texels[place] = texel_of(display(lit(colour, normal, 1.0)));
            }
    return texels;
}

}  // namespace osteomill
