// Colour of thin bone: the tissue behind it comes through, as the sinus does in blue and a nerve in pink.
//
//     share(w) = strength (exp(-w / depth) - exp(-1)) / (1 - exp(-1))     none from w = depth on
//
// Light is absorbed along its way w through bone (Beer and Lambert's law), shifted so that it ends at the
// depth. Bone scatters, so the way is not the ray's alone: from any point of the ray, light may turn aside to
// the tissue and is then absorbed twice as much,
//
//     w = min over t >= 0 of  t + 2 d(t)
//
// with d(t) the distance from the tissue of the ray's point t behind the surface. Before a flat layer that is
// the length of the ray in it, up to 60 degrees aslant; beside a nerve it rises without an edge. Depth and
// strength are the tissue's, the constants are the project's judgement. thin_bone.glsl has the same.
//
// Blue and bone's yellow mix to grey, so under bone a tissue's colour is more saturated than its own, with
// the same luminance.
//
// The bone's own colour is read away from the tissue, however thin it is. Labels of voxels do not tell bone
// of less than one from none, so from two voxels down the share rises to all of the tissue's colour.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "render_client/volume/bone_colours.h"

namespace osteomill {

/// Factor by which light that turns aside is absorbed more.
inline constexpr double thin_bone_aside = 2.0;

/// Factor on the saturation of a tissue's colour under bone.
inline constexpr float thin_bone_saturation = 2.0f;

/// The colour that a tissue of a linear RGB has under two voxels of bone or more.
inline glm::vec3 colour_under_bone(const glm::vec3& own) {
    const glm::vec3 grey(glm::dot(own, glm::vec3(0.2126f, 0.7152f, 0.0722f)));
    return glm::max(glm::mix(grey, own, thin_bone_saturation), glm::vec3(0.0f));
}

/// Share of a tissue's colour behind bone: 0 to its strength, by the way of light through the bone, in
/// depths.
inline double share_through_bone(double strength, double way_in_depths) {
    const double least = std::exp(-1.0);
    const double light = std::exp(-std::max(way_in_depths, 0.0));
    return strength * std::max((light - least) / (1.0 - least), 0.0);
}

/// A tissue as thin bone shows it.
struct SeenTissue {
    glm::vec3 colour{0.0f};  ///< linear RGB
    float strength = 0.0f;   ///< share of its colour under hardly any bone
    float depth_mm = 0.0f;   ///< of bone that hides it; 0: bone always does
};

/// By label.
using SeenTissues = std::array<SeenTissue, 256>;

inline SeenTissues seen_tissues(std::span<const TissueColour> tissues) {
    SeenTissues seen{};
    for (const TissueColour& tissue : tissues)
        seen[tissue.label] = {linear_from_srgb(tissue.srgb),
                              static_cast<float>(tissue.shows_through_strength),
                              static_cast<float>(tissue.shows_through_mm)};
    return seen;
}

}  // namespace osteomill
