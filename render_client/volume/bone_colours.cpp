#include "render_client/volume/bone_colours.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

namespace osteomill {

namespace {

using Srgb = std::array<std::uint8_t, 3>;

// Relative stiffness 1 is the cortical bone of the burr's coefficients; trabecular bone lies around a tenth
// of it, enamel above twice.
// CT blurs thin walls and surfaces, which then look softer than they are: so only marrow is reddish.
constexpr std::array<StiffnessColour, 6> stiffness_knots{{{0.0, {176, 122, 92}},
                                                          {0.04, {204, 164, 126}},
                                                          {0.12, {222, 193, 152}},
                                                          {0.4, {234, 213, 176}},
                                                          {1.0, {242, 228, 200}},
                                                          {2.5, {250, 248, 242}}}};

}  // namespace

glm::vec3 linear_from_srgb(const Srgb& srgb) {
    glm::vec3 linear;
    for (int channel = 0; channel < 3; ++channel) {
        const double value = srgb[static_cast<std::size_t>(channel)] / 255.0;
        linear[channel] =
            static_cast<float>(value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4));
    }
    return linear;
}

glm::vec3 plain_bone_colour() {
    return linear_from_srgb({236, 218, 184});
}

std::vector<TissueColour> tissue_colours(std::span<const Tissue> tissues) {
    std::vector<TissueColour> colours;
    for (const Tissue& tissue : tissues)
        colours.push_back({tissue.label, tissue.colour_rgb, tissue.opacity, tissue.shows_through_mm,
                           tissue.shows_through_strength});
    return colours;
}

ColourTable colours_by_tissue(std::span<const TissueColour> tissues) {
    ColourTable table;
    table.fill(plain_bone_colour());
    for (const TissueColour& tissue : tissues) table[tissue.label] = linear_from_srgb(tissue.srgb);
    return table;
}

std::span<const StiffnessColour> stiffness_colours() {
    return stiffness_knots;
}

glm::vec3 colour_of_stiffness(double relative_stiffness) {
    for (std::size_t knot = 1; knot < stiffness_knots.size(); ++knot) {
        const StiffnessColour& low = stiffness_knots[knot - 1];
        const StiffnessColour& high = stiffness_knots[knot];
        if (relative_stiffness > high.relative_stiffness) continue;
        const double part = (relative_stiffness - low.relative_stiffness) /
                            (high.relative_stiffness - low.relative_stiffness);
        return glm::mix(linear_from_srgb(low.srgb), linear_from_srgb(high.srgb), static_cast<float>(part));
    }
    return linear_from_srgb(stiffness_knots.back().srgb);
}

ColourTable colours_by_stiffness(double stiffness_per_code) {
    ColourTable table;
    for (std::size_t code = 0; code < table.size(); ++code)
        table[code] = colour_of_stiffness(static_cast<double>(code) * stiffness_per_code);
    return table;
}

}  // namespace osteomill
