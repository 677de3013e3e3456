#include "render_client/volume/textures/surface_voxels.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "render_client/volume/shaders/lighting.h"

namespace osteomill {

namespace {

constexpr int most_columns = 62;
constexpr std::size_t row_word_bytes = 8;

/// Step to a neighbour, numbered x fastest; number 13 is the voxel itself.
glm::ivec3 step_to(int number) {
    return glm::ivec3(number % 3, number / 3 % 3, number / 9) - 1;
}

/// Six times the direction to a neighbour over the distance: whole, because distances squared are 1, 2 or 3.
glm::ivec3 direction_to(int number) {
    const glm::ivec3 step = step_to(number);
    const int distance_squared = step.x * step.x + step.y * step.y + step.z * step.z;
    return distance_squared == 0 ? glm::ivec3(0) : step * (6 / distance_squared);
}

constexpr std::uint64_t top_bit_of_each = 0x8080808080808080U;

/// The top bits of eight bytes side by side, that of the first byte lowest.
std::uint64_t top_bits(std::uint64_t bytes) {
    // Bit 8 i times bit 56 - 7 i of the factor is bit 56 + i, and no two others meet there.
    return ((bytes & top_bit_of_each) >> 7U) * 0x0102040810204080U >> 56U;
}

/// Which voxels of a row are less than half full, and which of these are not empty.
struct RowBits {
    std::uint64_t outside = 0;
    std::uint64_t partial = 0;
};

/// Of at most 64 voxels; reads up to seven bytes beyond them.
RowBits bits_of_row(const std::uint8_t* fractions, std::size_t count) {
    static_assert(std::endian::native == std::endian::little);
    RowBits bits;
    for (std::size_t x = 0; x < count; x += row_word_bytes) {
        std::uint64_t bytes = 0;
        std::memcpy(&bytes, fractions + x, row_word_bytes);
        const std::uint64_t below_half = ~bytes;
        const std::uint64_t not_empty = (bytes & ~top_bit_of_each) + ~top_bit_of_each;
        bits.outside |= top_bits(below_half) << x;
        bits.partial |= top_bits(below_half & not_empty) << x;
    }
    const std::uint64_t within = count == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << count) - 1;
    return {bits.outside & within, bits.partial & within};
}

/// Three bits of each of three rows that follow each other, from the bit before `bit` on.
std::uint32_t nine_bits(const std::uint64_t* rows, int bit) {
    const int before = bit - 1;
    return static_cast<std::uint32_t>((rows[0] >> before & 7U) | (rows[1] >> before & 7U) << 3U |
                                      (rows[2] >> before & 7U) << 6U);
}

}  // namespace

SurfaceShader::SurfaceShader(const LookTable& table) : channel_(table.channel) {
    for (std::size_t code = 0; code < table.by_code.size(); ++code)
        display_by_code_[code] = glm::vec3(255.0 * display(glm::dvec3(table.by_code[code])));
    for (int number = 0; number < 27; ++number)
        directions_[static_cast<std::size_t>(number)] = direction_to(number);
    for (int layer = 0; layer < 3; ++layer)
        for (std::size_t outside = 0; outside < 512; ++outside) {
            glm::ivec3 sum(0);
            for (int bit = 0; bit < 9; ++bit)
                if ((outside >> bit & 1U) != 0) sum += direction_to(9 * layer + bit);
            directions_of_layer_[static_cast<std::size_t>(layer)][outside] = glm::i8vec3(sum);
        }
}

const std::vector<SurfaceTexel>& SurfaceShader::shade(const Bone& bone, const VoxelBox& box) {
    const VoxelBox bordered{box.first - 1, box.size + 2};
    fraction_.resize(bordered.count() + row_word_bytes);
    copy_channel(bone, BoneChannel::fraction, bordered, std::span(fraction_).first(bordered.count()));
    if (channel_) {
        code_.resize(box.count());
        copy_channel(bone, *channel_, box, code_);
    }
    rows_per_layer_ = static_cast<std::size_t>(bordered.size.y);
    outside_.resize(rows_per_layer_ * static_cast<std::size_t>(bordered.size.z));
    partial_.resize(outside_.size());
    for (int number = 0; number < 27; ++number) {
        const glm::ivec3 step = step_to(number);
        offsets_[static_cast<std::size_t>(number)] =
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
        const RowBits bits =
            bits_of_row(fraction_.data() + row * row_length + first_x, static_cast<std::size_t>(columns) + 2);
        outside_[row] = bits.outside;
        partial_[row] = bits.partial;
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
                texels_[place] = texel(outward(fraction_.data() + row * row_length + first_x + bit, row, bit),
                                       channel_ ? code_[place] : std::uint8_t{0});
            }
        }
}

glm::ivec3 SurfaceShader::outward(const std::uint8_t* own, std::size_t row, int bit) const {
    glm::ivec3 to_outside(0);
    std::uint32_t partial = 0;
    std::size_t first = row - rows_per_layer_ - 1;
    for (std::size_t layer = 0; layer < 3; ++layer, first += rows_per_layer_) {
        to_outside += glm::ivec3(directions_of_layer_[layer][nine_bits(&outside_[first], bit)]);
        partial |= nine_bits(&partial_[first], bit) << 9 * layer;
    }
    // As if all that is outside were empty, less what is not.
    glm::ivec3 sum = static_cast<int>(*own) * to_outside;
    for (; partial != 0; partial &= partial - 1) {
        const auto number = static_cast<std::size_t>(std::countr_zero(partial));
        sum -= static_cast<int>(own[offsets_[number]]) * directions_[number];
    }
    return sum;
}

SurfaceTexel SurfaceShader::texel(const glm::ivec3& outward, std::uint8_t code) const {
    // A single voxel in empty space looks to all sides: it is lit from above.
    const glm::vec3 light = light_.towards(outward == glm::ivec3(0) ? glm::ivec3(0, 0, 1) : outward);
    const glm::vec3 seen = display_by_code_[code] * light;
    const auto byte = [](float value) { return static_cast<std::uint8_t>(std::min(value, 255.0f) + 0.5f); };
    return {byte(seen.r), byte(seen.g), byte(seen.b), 255};
}

}  // namespace osteomill
