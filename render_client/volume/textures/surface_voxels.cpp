#include "render_client/volume/textures/surface_voxels.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

#include "render_client/volume/shaders/lighting.h"

namespace osteomill {

namespace {

/// Above the sum of all lights.
constexpr double brightest = 1.1;

/// Direction of a place in the square from -1 to 1: the octahedron's lower half is folded outwards.
glm::dvec3 direction_at(double x, double y) {
    const double z = 1.0 - std::abs(x) - std::abs(y);
    if (z >= 0.0) return glm::normalize(glm::dvec3(x, y, z));
    return glm::normalize(
        glm::dvec3(std::copysign(1.0 - std::abs(y), x), std::copysign(1.0 - std::abs(x), y), z));
}

}  // namespace

LightTable::LightTable() {
    lights_.reserve(static_cast<std::size_t>(edge) * edge);
    const auto place = [](int i) { return (i + 0.5) * 2.0 / edge - 1.0; };
    for (int y = 0; y < edge; ++y)
        for (int x = 0; x < edge; ++x) {
            const glm::dvec3 light = lit(glm::dvec3(1.0), direction_at(place(x), place(y)), 1.0);
            // As display(), without its clamping.
            const glm::dvec3 shown = glm::pow(light, glm::dvec3(1.0 / 2.2));
            lights_.emplace_back(glm::u8vec3(glm::round(shown * (255.0 / brightest))), std::uint8_t{0});
        }
}

glm::vec3 LightTable::towards(const glm::ivec3& outward) const {
    const int length = std::abs(outward.x) + std::abs(outward.y) + std::abs(outward.z);
    const float scale = 1.0f / static_cast<float>(length);
    float x = static_cast<float>(outward.x) * scale, y = static_cast<float>(outward.y) * scale;
    if (outward.z < 0) {
        const float folded_x = std::copysign(1.0f - std::abs(y), x);
        y = std::copysign(1.0f - std::abs(x), y);
        x = folded_x;
    }
    constexpr float half_edge = 0.5f * edge;
    // A little less than the edge, so that 1 falls into the last cell.
    const auto cell = [](float place) { return static_cast<int>((place + 1.0f) * (half_edge - 1e-4f)); };
    const glm::u8vec4& light = lights_[static_cast<std::size_t>(cell(y) * edge + cell(x))];
    return glm::vec3(light) * static_cast<float>(brightest / 255.0);
}

namespace {

constexpr int most_columns = 62;
constexpr std::size_t row_word_bytes = 8;

/// A step to a neighbour, and its direction over the distance, times six, which makes all of these whole
/// numbers: distances squared are 1, 2 or 3.
struct Neighbour {
    glm::ivec3 step;
    glm::ivec3 direction;
};

/// Half of the 26: the others lie opposite.
constexpr std::array<Neighbour, 13> half_of_neighbours = [] {
    std::array<Neighbour, 13> half{};
    for (int number = 14; number < 27; ++number) {
        const glm::ivec3 step(number % 3 - 1, number / 3 % 3 - 1, number / 9 - 1);
        const int distance_squared = step.x * step.x + step.y * step.y + step.z * step.z;
        const int scale = 6 / distance_squared;
        half[static_cast<std::size_t>(number - 14)] = {step,
                                                       {scale * step.x, scale * step.y, scale * step.z}};
    }
    return half;
}();

constexpr std::uint64_t top_bit_of_each = 0x8080808080808080U;

/// The top bits of eight bytes side by side, that of the first byte lowest.
std::uint64_t top_bits_of_eight(std::uint64_t bytes) {
    // Bit 8 i times bit 56 - 7 i of the factor is bit 56 + i, and no two others meet there.
    return ((bytes & top_bit_of_each) >> 7U) * 0x0102040810204080U >> 56U;
}

/// A bit for each voxel of a row, set if it is less than half full. A row has at most 64 voxels, and up to
/// seven bytes behind it are read.
std::uint64_t outside_of_row(const std::uint8_t* fractions, std::size_t count) {
    static_assert(std::endian::native == std::endian::little);
    std::uint64_t outside = 0;
    for (std::size_t x = 0; x < count; x += row_word_bytes) {
        std::uint64_t bytes = 0;
        std::memcpy(&bytes, fractions + x, row_word_bytes);
        outside |= top_bits_of_eight(~bytes) << x;
    }
    return count == 64 ? outside : outside & ((std::uint64_t{1} << count) - 1);
}

}  // namespace

SurfaceShader::SurfaceShader(const TransferTable& table) : voxel_codes_(table.codes), smoother_(table) {
    for (std::size_t code = 0; code < table.by_code.size(); ++code)
        display_by_code_[code] = glm::vec3(255.0 * display(glm::dvec3(table.by_code[code])));
}

const std::vector<SurfaceTexel>& SurfaceShader::shade(const Bone& bone, const VoxelBox& box) {
    const VoxelBox bordered{box.first - 1, box.size + 2};
    fraction_.resize(bordered.count() + row_word_bytes);
    copy_channel(bone, BoneChannel::fraction, bordered, std::span(fraction_).first(bordered.count()));
    if (voxel_codes_.exist()) {
        code_.resize(box.count());
        copy_stiffest_codes(bone, voxel_codes_, box, code_);
    }
    rows_per_layer_ = static_cast<std::size_t>(bordered.size.y);
    outside_.resize(rows_per_layer_ * static_cast<std::size_t>(bordered.size.z));
    smoothed_ = smoother_.smooth(bone, bordered);
    for (std::size_t i = 0; i < offsets_.size(); ++i) {
        const glm::ivec3& step = half_of_neighbours[i].step;
        offsets_[i] =
            (static_cast<std::ptrdiff_t>(step.z) * bordered.size.y + step.y) * bordered.size.x + step.x;
    }
    texels_.assign(box.count(), {});
    for (int x = 0; x < box.size.x; x += most_columns)
        shade_columns(box.size, x, std::min(most_columns, box.size.x - x));
    return texels_;
}

void SurfaceShader::shade_columns(const glm::ivec3& size, int first_x, int columns) {
    const auto row_length = static_cast<std::size_t>(size.x) + 2;
    for (std::size_t row = 0; row < outside_.size(); ++row) {
        outside_[row] = outside_of_row(fraction_.data() + row * row_length + first_x,
                                       static_cast<std::size_t>(columns) + 2);
    }
    const std::uint64_t without_borders = ((std::uint64_t{1} << columns) - 1) << 1U;
    for (int z = 0; z < size.z; ++z)
        for (int y = 0; y < size.y; ++y) {
            const std::size_t row = static_cast<std::size_t>(z + 1) * rows_per_layer_ + y + 1;
            std::uint64_t near_outside = 0;
            for (const std::size_t middle : {row - rows_per_layer_, row, row + rows_per_layer_})
                near_outside |= outside_[middle - 1] | outside_[middle] | outside_[middle + 1];
            near_outside |= near_outside << 1U | near_outside >> 1U;
            std::uint64_t surface = near_outside & ~outside_[row] & without_borders;
            const std::size_t first_place =
                (static_cast<std::size_t>(z) * size.y + y) * size.x + static_cast<std::size_t>(first_x);
            for (; surface != 0; surface &= surface - 1) {
                const int bit = std::countr_zero(surface);
                const std::size_t place = first_place + bit - 1;
                texels_[place] = texel(outward(smoothed_.data() + row * row_length + first_x + bit),
                                       voxel_codes_.exist() ? code_[place] : std::uint8_t{0});
            }
        }
}

glm::ivec3 SurfaceShader::outward(const std::uint8_t* own_smoothed) const {
    glm::ivec3 sum(0);
    for (std::size_t i = 0; i < offsets_.size(); ++i)
        sum += (own_smoothed[-offsets_[i]] - own_smoothed[offsets_[i]]) * half_of_neighbours[i].direction;
    return sum;
}

SurfaceTexel SurfaceShader::texel(const glm::ivec3& outward, std::uint8_t code) const {
    // A single voxel in empty space looks to all sides: it is lit from above.
    const glm::vec3 light = light_.towards(outward == glm::ivec3(0) ? glm::ivec3(0, 0, 1) : outward);
    const glm::vec3 seen = display_by_code_[code] * light;
    const auto byte = [](float value) { return static_cast<std::uint8_t>(std::min(value, 255.0f) + 0.5f); };
    return {byte(seen.r), byte(seen.g), byte(seen.b), 255};
}

SurfaceTexture::SurfaceTexture(const Bone& bone, const TransferTable& table, const AtlasLayout& places)
    : SurfaceTexture(table, gl::Texture3D(gl::VoxelFormat::interpolated_rgba, places.texture_size())) {
    finish(fill(bone, places));
}

Steps SurfaceTexture::fill(const Bone& bone, const AtlasLayout& places) {
    const std::vector<PlacedVoxels> all = places.all(bone.content());
    for (std::size_t region = 0; region < all.size(); ++region) {
        shade(bone, all[region]);
        co_yield static_cast<double>(region) / static_cast<double>(all.size());
    }
}

void SurfaceTexture::update(const Bone& bone, AtlasLayout& places, std::span<const VoxelBox> changed) {
    for (const PlacedVoxels& placed : places.that_show(bone, changed, 1 + smoothing_reach_voxels))
        shade(bone, placed);
}

void SurfaceTexture::shade(const Bone& bone, const PlacedVoxels& placed) {
    const std::vector<SurfaceTexel>& texels = shader_.shade(bone, placed.voxels);
    // Four bytes without padding, as the texture takes them.
    static_assert(sizeof(SurfaceTexel) == 4);
    texture_.upload(placed.first_texel, placed.voxels.size,
                    {reinterpret_cast<const std::uint8_t*>(texels.data()), 4 * texels.size()});
}

}  // namespace osteomill
