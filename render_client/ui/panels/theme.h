// Colours of panels, plots and background: light and dark, both safe for colour-blind users.
//
// Plots and warnings use Okabe and Ito's palette (Color Universal Design, 2008), in the light theme darkened
// until each stands out from the panel. Text has a contrast of at least 4.5 to its panel, lines of at least 3
// (WCAG 2.1, 1.4.3 and 1.4.11), as the tests check.
#pragma once

#include <array>
#include <cstdint>

#include "render_client/volume/scene_appearance.h"

namespace osteomill {

struct Rgba {
    std::uint8_t r = 0, g = 0, b = 0, a = 255;
};

enum class ThemeName { dark, light };

/// The meaning of a piece of text or of a line.
enum class Tone { plain, dim, good, warning, left, back, up, depth, removed };
inline constexpr std::size_t tone_count = 9;

struct Theme {
    std::array<Rgba, tone_count> tones;
    Rgba panel;  ///< behind text; a little of the picture shows through
    Rgba control, control_hovered, control_active;
    Rgba grid;                                  ///< in plots
    Rgba on_picture;                            ///< lines and letters over the picture, without a panel
    Rgba behind_letter;                         ///< round things on the picture
    glm::vec3 background_low, background_high;  ///< linear RGB, see SceneAppearance

    const Rgba& operator[](Tone tone) const { return tones[static_cast<std::size_t>(tone)]; }
};

const Theme& theme_of(ThemeName name);
ThemeName other_theme(ThemeName name);

}  // namespace osteomill
