#include "haptic_server/milling/tip_disc.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "haptic_server/milling/axis_means.h"
#include "haptic_server/milling/lanes.h"

namespace osteomill {

using lanes::Floats;

TipDisc::TipDisc(InstructionSet instructions) : instructions_(instructions) {
    constexpr double step = 2.0 * std::numbers::pi / static_cast<double>(angles);
    for (std::size_t i = 0; i < angles; ++i) {
        cosine_[i] = static_cast<float>(std::cos((static_cast<double>(i) + 0.5) * step));
        sine_[i] = static_cast<float>(std::sin((static_cast<double>(i) + 0.5) * step));
    }
    // Rings as wide as each other within the disc of the means, and without.
    constexpr auto means = static_cast<double>(axis_disc_voxels);
    constexpr auto disc = static_cast<double>(tip_disc_voxels);
    const auto bound = [&](std::size_t i) {
        const auto place = static_cast<double>(i);
        constexpr auto within = static_cast<double>(circles_under_means);
        return i <= circles_under_means ? means * place / within
                                        : means + (disc - means) * (place - within) /
                                                      static_cast<double>(circles - circles_under_means);
    };
    constexpr int parts = 50;
    for (std::size_t i = 0; i < circles; ++i) {
        Circle& circle = circles_[i];
        const double width = bound(i + 1) - bound(i);
        const double middle = 0.5 * (bound(i) + bound(i + 1));
        circle.radius = static_cast<float>(middle);
        circle.half_width_per_radius = static_cast<float>(0.5 * width / middle);
        double volume = 0.0;
        double swirl = 0.0;
        double inverse = 0.0;
        for (int part = 0; part < parts; ++part) {
            const double r = bound(i) + width * (part + 0.5) / parts;
            const AxisMeans<double> mean = axis_means(r * r, 1.0 / r);
            volume += (1.0 - r * r / (disc * disc)) * r;
            swirl += 1.0 - mean.swirl * r * r;
            inverse += 1.0 - mean.inverse * r;
        }
        const double area = step * width / parts;
        circle.for_volume = static_cast<float>(volume * area);
        circle.for_missing_swirl = static_cast<float>(swirl * area);
        circle.for_missing_inverse = static_cast<float>(inverse * area);
    }
}

void TipDisc::begin(double radius_voxels, const glm::dvec3& direction) noexcept {
    direction_ = glm::vec3(direction);
    if (radius_voxels == radius_voxels_) return;
    radius_voxels_ = radius_voxels;
    for (Circle& circle : circles_) {
        const auto r = static_cast<double>(circle.radius);
        const double rise = std::sqrt(radius_voxels * radius_voxels - r * r);
        circle.rise = static_cast<float>(rise);
        circle.slope = static_cast<float>(r / rise);
    }
}

struct TipDisc::Kernel {
    const TipDisc& of;

    /// Sums over a circle.
    struct Round {
        Floats chip{}, chip_x{}, chip_y{};
        Floats band{}, band_x{}, band_y{};
        Floats turn{}, turn_x{}, turn_y{};
    };

    /// `limit`: of u . (x, y) on this circle.
    [[gnu::always_inline]] Round round(const Circle& circle, const glm::vec2& u, float limit) const {
        constexpr auto step = static_cast<float>(2.0 * std::numbers::pi / static_cast<double>(angles));
        const glm::vec3 v = of.direction_;
        const Floats zero{};
        const Floats one = lanes::floats(1.0f);
        Round sum;
        for (std::size_t i = 0; i < angles; i += lanes::width) {
            const Floats c = lanes::load<Floats>(&of.cosine_[i]);
            const Floats s = lanes::load<Floats>(&of.sine_[i]);
            Floats chip = circle.slope * (v.x * c + v.y * s) - v.z;
            chip = chip < 0.0f ? zero : chip;
            const Floats out = circle.radius * (u.x * c + u.y * s);
            const Floats along = circle.radius * (u.x * s - u.y * c);
            // How wide the cell is across the face.
            const Floats width = step * (along < 0.0f ? -along : along) +
                                 circle.half_width_per_radius * (out < 0.0f ? -out : out) + 1e-3f;
            const Floats per_width = 1.0f / width;
            Floats share = 0.5f + (limit - out) * per_width;
            const auto is_cut = (share > 0.0f) & (share < 1.0f);
            share = share < 0.0f ? zero : share;
            share = share > 1.0f ? one : share;
            const Floats kept = chip * share;
            const Floats band = is_cut ? chip * per_width : zero;
            const Floats turn = -along * band;
            sum.chip += kept;
            sum.chip_x += kept * c;
            sum.chip_y += kept * s;
            sum.band += band;
            sum.band_x += band * c;
            sum.band_y += band * s;
            sum.turn += turn;
            sum.turn_x += turn * c;
            sum.turn_y += turn * s;
        }
        return sum;
    }

    [[gnu::always_inline]] TipDiscSums sums(const FaceAtTip& face, bool is_whole) const {
        const double squared = of.radius_voxels_ * of.radius_voxels_;
        const double d = face.distance_voxels;
        const double rise_at_face = std::sqrt(squared - d * d);
        const glm::vec2 u(face.outward);
        Round volume;
        Floats missing{};
        Floats missing_x{};
        Floats missing_y{};
        for (const Circle& circle : of.circles_) {
            const auto r = static_cast<double>(circle.radius);
            const double bend =
                face.cot_theta * (d * d - r * r) / (static_cast<double>(circle.rise) + rise_at_face);
            const Round sum = round(circle, u, is_whole ? 1e3f : static_cast<float>(d + bend));
            const float moment = circle.for_volume * circle.radius;
            volume.chip += circle.for_volume * sum.chip;
            volume.chip_x += moment * sum.chip_x;
            volume.chip_y += moment * sum.chip_y;
            volume.band += circle.for_volume * sum.band;
            volume.band_x += moment * sum.band_x;
            volume.band_y += moment * sum.band_y;
            volume.turn += circle.for_volume * sum.turn;
            volume.turn_x += moment * sum.turn_x;
            volume.turn_y += moment * sum.turn_y;
            missing_x += circle.for_missing_swirl * sum.chip_x;
            missing_y += circle.for_missing_swirl * sum.chip_y;
            missing += circle.for_missing_inverse * circle.rise * sum.chip;
        }
        // The face, as it moves, bends.
        const double advance = 1.0 + face.cot_theta * d / rise_at_face;
        return {lanes::sum(volume.chip),
                {lanes::sum(volume.chip_x), lanes::sum(volume.chip_y)},
                {lanes::sum(missing_x), lanes::sum(missing_y), lanes::sum(missing) / of.radius_voxels_},
                advance *
                    glm::dvec3(lanes::sum(volume.band), lanes::sum(volume.band_x), lanes::sum(volume.band_y)),
                {lanes::sum(volume.turn), lanes::sum(volume.turn_x), lanes::sum(volume.turn_y)}};
    }
};

TipDiscSums TipDisc::sums_plain(const FaceAtTip& face, bool is_whole) const noexcept {
    return Kernel{*this}.sums(face, is_whole);
}

#if defined(__x86_64__)
[[gnu::target("avx2")]] TipDiscSums TipDisc::sums_avx2(const FaceAtTip& face, bool is_whole) const noexcept {
    return Kernel{*this}.sums(face, is_whole);
}
#endif

TipDiscSums TipDisc::sums(const FaceAtTip& face, bool is_whole) const noexcept {
#if defined(__x86_64__)
    if (instructions_ == InstructionSet::avx2) return sums_avx2(face, is_whole);
#endif
    return sums_plain(face, is_whole);
}

TipDiscSums TipDisc::whole() const noexcept {
    return sums({}, true);
}

TipDiscSums TipDisc::cut_by(const FaceAtTip& face) const noexcept {
    return sums(face, false);
}

}  // namespace osteomill
