// Colours of bone: one for each tissue label or, if the scene has no labels, for each stiffness.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "common/scene/scene.h"

namespace osteomill {

/// Linear RGB by byte code.
using ColourTable = std::array<glm::vec3, 256>;

struct TissueColour {
    std::uint8_t label = 0;
    std::array<std::uint8_t, 3> srgb{};
    /// Share of light that a millimetre of it absorbs: 1 is solid, 0 hides it.
    double opacity = 1.0;
    double shows_through_mm = 0.0;  ///< thinner bone shows its colour (thin_bone.h); 0: none does
    double shows_through_strength = 0.0;
};

/// Colour of bone of a stiffness.
struct StiffnessColour {
    double relative_stiffness = 0.0;
    std::array<std::uint8_t, 3> srgb{};
};

/// sRGB (IEC 61966-2-1) to linear light.
glm::vec3 linear_from_srgb(const std::array<std::uint8_t, 3>& srgb);

/// Colour of bone without a tissue or stiffness: a warm ivory.
glm::vec3 plain_bone_colour();

/// Tissues as pictures show them.
std::vector<TissueColour> tissue_colours(std::span<const Tissue> tissues);

/// Colours by label; labels without a colour look like plain bone.
ColourTable colours_by_tissue(std::span<const TissueColour> tissues);

/// The knots between which bone is coloured by stiffness, ascending.
std::span<const StiffnessColour> stiffness_colours();

/// Linear RGB of bone of a stiffness, in linear light between the knots.
glm::vec3 colour_of_stiffness(double relative_stiffness);

/// Colours by stiffness code: spongy bone reddish brown, dentine and cortical bone ivory, enamel near white.
ColourTable colours_by_stiffness(double stiffness_per_code);

}  // namespace osteomill
