#include "simulation/engagement/patch_crossings.h"

#include <algorithm>
#include <bit>

#include "simulation/carving/simd.h"
#include "simulation/engagement/engagement.h"

namespace osteomill {

using simd::Floats;
using simd::Floats3;
using simd::Ints;

namespace {

/// Places along a patch's normal at which the bone is sampled, from the burr's surface.
constexpr std::array<float, 4> offsets_voxels{-static_cast<float>(Engagement::reach_voxels), -0.5f, 0.5f,
                                              static_cast<float>(Engagement::reach_voxels)};

/// Half a voxel behind the face that a burr has just cut, at least this much is seen of whole bone; so bone of
/// more is whole.
constexpr float whole_near_face = 0.85f * 255.0f;
/// Less may be the ramp of a wall beside the burr.
constexpr float least_fraction = 0.3f * 255.0f;

/// Fractions, 0 to 255, trilinear between the centres of voxels, at eight positions from the bricks' base.
[[gnu::always_inline]] inline Floats fractions_at(const BrickNeighbourhood& bricks, Floats3 position) {
    const Ints x = __builtin_convertvector(position.x, Ints);
    const Ints y = __builtin_convertvector(position.y, Ints);
    const Ints z = __builtin_convertvector(position.z, Ints);
    const Ints brick = (x >> 4) + bricks.edge() * ((y >> 4) + bricks.edge() * (z >> 4));
    const Ints in_brick = (x & 15) | (y & 15) << 4 | (z & 15) << 8;
    const unsigned across = simd::bits_of(((x & 15) == 15) | ((y & 15) == 15) | ((z & 15) == 15));
    // The low and the high four corners of each.
    Ints low;
    Ints high;
    std::uint64_t any = 0;
    for (std::size_t lane = 0; lane < simd::width; ++lane) {
        const std::uint64_t corners = (across >> lane & 1u) != 0
                                          ? bricks.corners_across(brick[lane], in_brick[lane])
                                          : bricks.corners_within(brick[lane], in_brick[lane]);
        low[lane] = static_cast<std::int32_t>(corners & 0xffffffffu);
        high[lane] = static_cast<std::int32_t>(corners >> 32);
        any |= corners;
    }
    if (any == 0) return Floats{};
    std::array<Floats, 8> c;
    for (int corner = 0; corner < 4; ++corner) {
        c[static_cast<std::size_t>(corner)] = simd::to_floats(low >> (8 * corner) & 255);
        c[static_cast<std::size_t>(corner) + 4] = simd::to_floats(high >> (8 * corner) & 255);
    }
    return detail::trilinear<Floats>(c, position.x - simd::to_floats(x), position.y - simd::to_floats(y),
                                     position.z - simd::to_floats(z));
}

[[gnu::always_inline]] inline Floats3 along_axes(const glm::mat3& frame, const Floats3& v) {
    return {frame[0].x * v.x + frame[1].x * v.y + frame[2].x * v.z,
            frame[0].y * v.x + frame[1].y * v.y + frame[2].y * v.z,
            frame[0].z * v.x + frame[1].z * v.y + frame[2].z * v.z};
}

[[gnu::always_inline]] inline Floats3 load3(const std::array<std::vector<float>, 3>& from, std::size_t i) {
    return {simd::load<Floats>(&from[0][i]), simd::load<Floats>(&from[1][i]),
            simd::load<Floats>(&from[2][i])};
}

}  // namespace

struct PatchCrossings::Look {
    const BrickNeighbourhood& bricks;
    glm::mat3 frame;
    glm::vec3 centre;
    float radius;
    InsideBurr inside;
};

struct PatchCrossings::Loops {
    PatchCrossings& to;

    [[gnu::always_inline]] static Floats sample(const Look& look, const Floats3& surface,
                                                const Floats3& outward, std::size_t i) {
        const float offset = offsets_voxels[i];
        return fractions_at(look.bricks, {surface.x + offset * outward.x, surface.y + offset * outward.y,
                                          surface.z + offset * outward.z});
    }

    /// Finds the crossings of patches `first` to `first` + 7, writes them to `found` and returns their
    /// number.
    [[gnu::always_inline]] std::size_t find_eight(const Look& look, std::size_t first,
                                                  PatchCrossing* found) const {
        const Floats3 outward = along_axes(look.frame, load3(to.normals_, first));
        Floats3 surface{look.centre.x + look.radius * outward.x, look.centre.y + look.radius * outward.y,
                        look.centre.z + look.radius * outward.z};
        if (to.has_beside_) {
            const Floats3 beside = along_axes(look.frame, load3(to.beside_voxels_, first));
            surface = {surface.x + beside.x, surface.y + beside.y, surface.z + beside.z};
        }
        std::array<Floats, 4> fractions;
        fractions.fill(Floats{});
        constexpr unsigned all = 0xff;
        // The sample half a voxel outside tells to which side bone begins.
        fractions[2] = sample(look, surface, outward, 2);
        if (simd::bits_of(fractions[2] >= whole_near_face) != all)
            fractions[3] = sample(look, surface, outward, 3);
        if (look.inside == InsideBurr::any) fractions[0] = sample(look, surface, outward, 0);
        if (look.inside == InsideBurr::any || simd::bits_of(fractions[2] >= 0.5f * least_fraction) != 0)
            fractions[1] = sample(look, surface, outward, 1);

        Floats behind = simd::larger(fractions[2], fractions[3]);
        behind = fractions[2] >= whole_near_face ? simd::floats(255.0f) : behind;
        // With little ahead a burr may yet stand in bone; and so may one that has not carved.
        behind = behind >= least_fraction ? behind : simd::floats(255.0f);
        if (look.inside == InsideBurr::any) behind = simd::floats(255.0f);
        // From the outside inward, so the innermost crossing remains.
        Floats offset = simd::floats(0.0f);
        Floats bone_offset = offset;
        Floats share = simd::floats(1.0f);
        Ints is_found{};
        for (std::size_t i = offsets_voxels.size(); i-- > 0;) {
            const bool is_far = i == 3;
            const Floats level = is_far ? simd::floats(surface_fraction) : 0.5f * behind;
            const Ints is_in_bone = fractions[i] >= level;
            const Floats at = i == 0 ? simd::floats(offsets_voxels[0])
                                     : offsets_voxels[i - 1] + (offsets_voxels[i] - offsets_voxels[i - 1]) *
                                                                   (level - fractions[i - 1]) /
                                                                   (fractions[i] - fractions[i - 1]);
            offset = is_in_bone ? at : offset;
            bone_offset = is_in_bone ? simd::floats(offsets_voxels[i]) : bone_offset;
            if (!is_far) share = is_in_bone ? behind * (1.0f / 255.0f) : share;
            is_found |= is_in_bone;
        }
        if (simd::bits_of(is_found) == 0) return 0;
        // Half of what a rim has is what a burr that touches it leaves inside itself.
        const Floats outward_by = 0.5f - 0.5f * share;
        const Floats put_right = offset + outward_by > 0.0f ? simd::floats(0.0f) : offset + outward_by;
        offset = offset < 0.0f ? put_right : offset;
        std::size_t count = 0;
        for (unsigned left = simd::bits_of(is_found); left != 0; left &= left - 1) {
            const auto lane = static_cast<std::size_t>(std::countr_zero(left));
            if (first + lane >= to.count_) break;
            found[count++] = {static_cast<std::int32_t>(first + lane), offset[lane], bone_offset[lane],
                              share[lane]};
        }
        return count;
    }

    [[gnu::always_inline]] std::size_t find(const Look& look) const {
        std::size_t count = 0;
        for (std::size_t first = 0; first < to.count_; first += simd::width)
            count += find_eight(look, first, to.found_.data() + count);
        return count;
    }
};

PatchCrossings::PatchCrossings(std::span<const BurrPatch> patches, double spacing_mm,
                               InstructionSet instructions)
    : count_(patches.size()), instructions_(instructions), found_(patches.size()) {
    const std::size_t padded = (count_ + simd::width - 1) / simd::width * simd::width;
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (std::size_t i = 0; i < padded; ++i) {
            const BurrPatch& patch = patches[std::min(i, count_ - 1)];
            const auto at = static_cast<int>(axis);
            normals_[axis].push_back(static_cast<float>(patch.normal[at]));
            beside_voxels_[axis].push_back(static_cast<float>(patch.beside_mm[at] / spacing_mm));
            has_beside_ |= patch.beside_mm[at] != 0.0;
        }
}

std::span<const PatchCrossing> PatchCrossings::find(const BrickNeighbourhood& bricks, const glm::mat3& frame,
                                                    const glm::vec3& centre_voxels, float radius_voxels,
                                                    InsideBurr inside) noexcept {
    const Look look{bricks, frame, centre_voxels, radius_voxels, inside};
#if defined(__x86_64__)
    if (instructions_ == InstructionSet::avx2) return {found_.data(), find_avx2(look)};
#endif
    return {found_.data(), find_plain(look)};
}

std::size_t PatchCrossings::find_plain(const Look& look) noexcept {
    return Loops{*this}.find(look);
}

#if defined(__x86_64__)
[[gnu::target("avx2")]] std::size_t PatchCrossings::find_avx2(const Look& look) noexcept {
    return Loops{*this}.find(look);
}
#endif

}  // namespace osteomill
