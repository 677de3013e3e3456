#include "render_client/volume/transfer_function.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <stdexcept>

#include "common/scene/stiffness_relation.h"
#include "render_client/volume/bone_colours.h"

namespace osteomill {

namespace {

// From soft tissue up to enamel: spongy bone and thin walls of 300 HU are mid-grey, cortical bone and
// dentine light, enamel white.
constexpr double window_centre_hu = 450.0;
constexpr double window_width_hu = 2900.0;

TransferFunction bone_preset() {
    TransferFunction bone{.name = "bone"};
    for (const StiffnessColour& knot : stiffness_colours())
        bone.points.push_back({knot.relative_stiffness, knot.srgb, 1.0});
    return bone;
}

TransferFunction tooth_preset() {
    // Dentine is about as stiff as cortical bone, so the jaw's outer wall stands with the teeth.
    return {.name = "tooth",
            .mode = TransferMode::translucent,
            .points = {{0.0, {196, 150, 122}, 0.06},
                       {0.3, {214, 178, 138}, 0.10},
                       {0.8, {226, 190, 130}, 0.45},
                       {1.2, {236, 214, 170}, 0.60},
                       {1.6, {246, 244, 236}, 0.92},
                       {2.5, {250, 250, 250}, 0.97}}};
}

}  // namespace

glm::vec4 look_of(const TransferFunction& function, double value) {
    const auto look = [](const TransferPoint& point) {
        return glm::vec4(linear_from_srgb(point.srgb), static_cast<float>(point.opacity));
    };
    if (value <= function.points.front().value) return look(function.points.front());
    for (std::size_t i = 1; i < function.points.size(); ++i) {
        const TransferPoint& low = function.points[i - 1];
        const TransferPoint& high = function.points[i];
        if (value > high.value) continue;
        const double part = (value - low.value) / (high.value - low.value);
        return glm::mix(look(low), look(high), static_cast<float>(part));
    }
    return look(function.points.back());
}

void require_valid(const TransferFunction& function) {
    if (function.points.empty())
        throw std::invalid_argument("transfer function '" + function.name + "' has no control point");
    for (std::size_t i = 0; i < function.points.size(); ++i) {
        const TransferPoint& point = function.points[i];
        const auto refuse = [&](const std::string& what) {
            throw std::invalid_argument(
                fmt::format("transfer function '{}', point {}: {}", function.name, i + 1, what));
        };
        if (!std::isfinite(point.value)) refuse("its value is no number");
        if (i > 0 && !(point.value > function.points[i - 1].value))
            refuse(fmt::format("its value {} must be above the {} before it", point.value,
                               function.points[i - 1].value));
        if (!(point.opacity >= 0.0 && point.opacity <= 1.0))
            refuse(fmt::format("its opacity is {}, must be 0 to 1", point.opacity));
    }
}

TransferFunction ct_window(double centre_hu, double width_hu) {
    const double black_hu = centre_hu - 0.5 * width_hu;
    const StiffnessRelation relation = default_stiffness_relation();
    const auto grey_point = [&](double hu, double part, double opacity) {
        const auto grey = static_cast<std::uint8_t>(std::lround(255.0 * part));
        return TransferPoint{relative_stiffness(relation, hu), {grey, grey, grey}, opacity};
    };
    // Many points, because grey levels are even in HU and on the display, while stiffness is a power of HU
    // and colours blend in linear light. Opacity rises over more than one code of stiffness, or the edge of
    // hidden bone would be stairs.
    constexpr int points = 25;
    constexpr double hidden_part = 0.2, opaque_part = 0.28;
    TransferFunction window{.name = "ct-window"};
    for (int i = 0; i < points; ++i) {
        const double part = hidden_part + (1.0 - hidden_part) * i / (points - 1);
        const TransferPoint point =
            grey_point(black_hu + part * width_hu, part,
                       std::clamp((part - hidden_part) / (opaque_part - hidden_part), 0.0, 1.0));
        // The relation is flat below bone: of points of equal stiffness the last one counts.
        if (!window.points.empty() && point.value <= window.points.back().value) window.points.pop_back();
        window.points.push_back(point);
    }
    return window;
}

std::span<const TransferFunction> transfer_presets() {
    static const std::vector<TransferFunction> presets{bone_preset(), tooth_preset(),
                                                       ct_window(window_centre_hu, window_width_hu)};
    return presets;
}

}  // namespace osteomill
