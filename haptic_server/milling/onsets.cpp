#include "haptic_server/milling/onsets.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "haptic_server/milling/lanes.h"
#include "haptic_server/milling/stiffness_weights.h"

namespace osteomill {

using lanes::Floats;
using lanes::Ints;

namespace {

/// A shorter way has no direction in single precision.
constexpr double shortest_way_voxels = 1e-6;

}  // namespace

static_assert(lanes::width == AwaitingVoxels::lanes && lanes::width == RemovedVoxels::lanes);

Onsets::Onsets(double radius_voxels, VoxelEdges edges, const BoneContent& content,
               InstructionSet instructions) noexcept
    : radius_(static_cast<float>(radius_voxels)),
      reach_(static_cast<float>(radius_voxels + rim_voxels(edges))),
      edges_(edges),
      content_(content),
      instructions_(instructions) {}

struct Onsets::Kernel {
    Onsets& to;

    /// Where the ramp leaves so much of a voxel.
    struct RampPlace {
        Floats beyond;  ///< the centre's distance less the radius
        Floats slope;
    };

    /// Rows of voxels, met a period apart.
    struct Rows {
        float period;
        float per_period;

        [[gnu::always_inline]] Floats less_a_period(const Floats& way) const {
            return way > period ? way - period : way;
        }
        /// P of onsets.h: what a row is given from here on until it is met, over the rate at which it then
        /// loses.
        [[gnu::always_inline]] Floats given_until_met(const Floats& way) const {
            return 0.5f * way * (1.0f - way * per_period);
        }
    };

    [[gnu::always_inline]] static RampPlace partial_place(const Floats& left) {
        return {left * (1.0f / 255.0f) - 0.5f, lanes::floats(1.0f)};
    }

    [[gnu::always_inline]] static RampPlace soft_place(const Floats& left) {
        constexpr auto mean_over = static_cast<float>(detail::soft_mean_over);
        constexpr float straight_to = 0.5f - 0.5f * mean_over;
        const Floats off_half = left * (1.0f / 255.0f) - 0.5f;
        const Floats size = off_half < 0.0f ? -off_half : off_half;
        const Floats bent = size > straight_to ? size - straight_to : Floats{};
        const Floats slope_squared = 1.0f - bent * (2.0f / mean_over);
        const Floats slope = lanes::square_root(slope_squared > 0.0f ? slope_squared : Floats{});
        const Floats beyond = size - bent + mean_over * (1.0f - slope);
        return {off_half < 0.0f ? -beyond : beyond, slope};
    }

    [[gnu::always_inline]] void find(const AwaitingVoxels& awaiting) {
        const auto length = static_cast<float>(glm::length(awaiting.along));
        const glm::vec3 v = glm::vec3(awaiting.along) / length;
        const glm::vec3 at(awaiting.from + awaiting.along);
        const glm::vec3 across = glm::abs(v);
        const float period = 1.0f / std::max({across.x, across.y, across.z});
        const float radius = to.radius_;
        const float reach_squared = to.reach_ * to.reach_;
        const bool is_soft = to.edges_ == VoxelEdges::soft;
        const Rows rows{period, 1.0f / period};
        RemovedVoxels& out = to.voxels_;
        for (std::size_t i = 0; i < awaiting.padded_count(); i += lanes::width) {
            const Floats x = lanes::load<Floats>(&awaiting.x[i]);
            const Floats y = lanes::load<Floats>(&awaiting.y[i]);
            const Floats z = lanes::load<Floats>(&awaiting.z[i]);
            const Floats left = lanes::load<Floats>(&awaiting.left[i]);
            const Floats wx = x - at.x;
            const Floats wy = y - at.y;
            const Floats wz = z - at.z;
            // It awaits the burr until the ramp is rounded to what is left.
            const Floats rounded = left + 0.5f;
            const RampPlace place = is_soft ? soft_place(rounded) : partial_place(rounded);
            const Floats met = radius + place.beyond;
            const Floats ahead = wx * v.x + wy * v.y + wz * v.z;
            const Floats still = wx * wx + wy * wy + wz * wz - met * met;
            const Floats beyond_still = still > 0.0f ? still : Floats{};  // but for rounding it is
            const Floats root_squared = ahead * ahead - beyond_still;
            // After a period the centre is within the distance, or has been.
            const Ints within_period = (ahead < period) | (beyond_still < period * (2.0f * ahead - period));
            const Ints is_met = (left > 0.0f) & (root_squared > 0.0f) & (ahead > 0.0f) & within_period;
            if (!lanes::any(is_met)) continue;
            const Floats root = lanes::square_root(is_met ? root_squared : lanes::floats(1.0f));
            const Ints is_next = is_met & (met * met + period * (period + 2.0f * root) < reach_squared);
            const Floats way = is_next ? beyond_still / (ahead + root) : Floats{};
            const Floats before = rows.less_a_period(rows.less_a_period(way + length));
            const Floats rate = place.slope * root / met;
            const Floats given = rate * (rows.given_until_met(before) - rows.given_until_met(way));
            const Floats until = is_next ? way + 0.5f * length : Floats{};
            const std::size_t n = out.count;
            lanes::store(&out.x[n], x - until * v.x);
            lanes::store(&out.y[n], y - until * v.y);
            lanes::store(&out.z[n], z - until * v.z);
            lanes::store(&out.codes[n], is_next ? 255.0f * given : Floats{});
            lanes::store(&out.slot[n], lanes::load<Ints>(&awaiting.slot[i]));
            lanes::store(&out.offset[n], lanes::load<Ints>(&awaiting.offset[i]));
            out.count += lanes::width;
        }
    }
};

void Onsets::find_plain(const AwaitingVoxels& awaiting) noexcept {
    Kernel{*this}.find(awaiting);
}

#if defined(__x86_64__)
[[gnu::target("avx2")]] void Onsets::find_avx2(const AwaitingVoxels& awaiting) noexcept {
    Kernel{*this}.find(awaiting);
}
#endif

void Onsets::take(const AwaitingVoxels& awaiting) noexcept {
    voxels_.base = awaiting.base;
    voxels_.count = 0;
    const bool is_at_rest = glm::length(awaiting.along) < shortest_way_voxels;
    if (edges_ == VoxelEdges::whole || is_at_rest || codes_left_ == 0.0) return;
#if defined(__x86_64__)
    if (instructions_ == InstructionSet::avx2)
        find_avx2(awaiting);
    else
#endif
        find_plain(awaiting);
    weigh();
}

void Onsets::weigh() noexcept {
    const double wanted = std::abs(voxels_.lost_codes());
    const double granted = std::min(wanted, codes_left_);
    codes_left_ -= granted;
    weigh_by_stiffness(content_, voxels_, wanted > granted ? granted / wanted : 1.0, weights_);
}

}  // namespace osteomill
