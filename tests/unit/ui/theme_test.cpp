#include "render_client/ui/panels/theme.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "render_client/volume/bone_colours.h"

namespace osteomill::theme_test {
namespace {

glm::dvec3 linear(const Rgba& colour) {
    return linear_from_srgb({colour.r, colour.g, colour.b});
}

double luminance(const Rgba& colour) {
    return glm::dot(linear(colour), glm::dvec3(0.2126, 0.7152, 0.0722));
}

/// WCAG 2.1: 1 to 21.
double contrast(const Rgba& a, const Rgba& b) {
    const double brighter = std::max(luminance(a), luminance(b)),
                 darker = std::min(luminance(a), luminance(b));
    return (brighter + 0.05) / (darker + 0.05);
}

/// The panel's colour where a grey picture is behind it.
Rgba over(const Rgba& panel, int grey) {
    const double share = panel.a / 255.0;
    const auto mixed = [&](std::uint8_t colour) {
        return static_cast<std::uint8_t>(std::lround(share * colour + (1.0 - share) * grey));
    };
    return {mixed(panel.r), mixed(panel.g), mixed(panel.b)};
}

/// CIE 1976 L*a*b* of linear RGB (sRGB primaries, D65).
glm::dvec3 lab(const glm::dvec3& rgb) {
    const glm::dvec3 white(0.9505, 1.0, 1.089);
    const glm::dvec3 xyz(glm::dot(rgb, glm::dvec3(0.4124, 0.3576, 0.1805)),
                         glm::dot(rgb, glm::dvec3(0.2126, 0.7152, 0.0722)),
                         glm::dot(rgb, glm::dvec3(0.0193, 0.1192, 0.9505)));
    glm::dvec3 f;
    for (int i = 0; i < 3; ++i) {
        const double part = std::max(xyz[i] / white[i], 0.0);
        f[i] = part > 0.008856 ? std::cbrt(part) : 7.787 * part + 16.0 / 116.0;
    }
    return {116.0 * f.y - 16.0, 500.0 * (f.x - f.y), 200.0 * (f.y - f.z)};
}

/// Colours as a dichromat sees them, severity 1 of Machado, Oliveira and Fernandes (2009), rows over linear
/// RGB.
const glm::dmat3 as_seen_by_all(1.0);
const glm::dmat3 as_seen_by_protanopes = glm::transpose(
    glm::dmat3(0.152286, 1.052583, -0.204868, 0.114503, 0.786281, 0.099216, -0.003882, -0.048116, 1.051998));
const glm::dmat3 as_seen_by_deuteranopes = glm::transpose(
    glm::dmat3(0.367322, 0.860646, -0.227968, 0.280085, 0.672501, 0.047413, -0.011820, 0.042940, 0.968881));

class EveryTheme : public ::testing::TestWithParam<ThemeName> {
  protected:
    const Theme& theme = theme_of(GetParam());
};

TEST_P(EveryTheme, KeepsTextAndLinesApartFromThePanel) {
    // Lines have readings in their colours, and keys in the help; a picture shows through the panel.
    for (std::size_t tone = 0; tone < tone_count; ++tone)
        for (const int grey : {0, 128, 255})
            EXPECT_GE(contrast(theme.tones[tone], over(theme.panel, grey)), 4.5)
                << "tone " << tone << " over a picture of " << grey;
    for (const Tone tone : {Tone::plain, Tone::dim})
        for (const Rgba& behind : {theme.control, theme.control_hovered, theme.control_active})
            EXPECT_GE(contrast(theme[tone], behind), 4.5) << "letters on buttons, cards and sliders";
    EXPECT_GE(contrast(theme.on_picture, theme.behind_letter), 4.5);
}

TEST_P(EveryTheme, TellsTheForcesApartForEveryKindOfColourVision) {
    const std::array<Tone, 3> axes{Tone::left, Tone::back, Tone::up};
    for (const glm::dmat3& sight : {as_seen_by_all, as_seen_by_protanopes, as_seen_by_deuteranopes})
        for (std::size_t i = 0; i < axes.size(); ++i)
            for (std::size_t j = 0; j < i; ++j) {
                const auto seen = [&](Tone tone) {
                    return lab(glm::clamp(sight * linear(theme[tone]), 0.0, 1.0));
                };
                // Ten of these units apart is plain at a glance.
                EXPECT_GT(glm::distance(seen(axes[i]), seen(axes[j])), 20.0) << i << " and " << j;
            }
}

INSTANTIATE_TEST_SUITE_P(Themes, EveryTheme, ::testing::Values(ThemeName::dark, ThemeName::light),
                         [](const auto& tested) {
                             return tested.param == ThemeName::dark ? std::string("dark")
                                                                    : std::string("light");
                         });

}  // namespace
}  // namespace osteomill::theme_test
