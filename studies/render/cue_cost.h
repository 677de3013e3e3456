// Cost and gain of each cue of the picture: frames with it and without, drawn in turns in one run, and how
// much nearer to a supersampled picture it makes silhouettes.
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec2.hpp>
#include <string_view>

#include "render_client/volume/camera.h"
#include "render_client/volume/scene_appearance.h"
#include "render_client/volume/textures/bone_textures.h"

namespace osteomill::study {

/// Parts of the picture beside colour and lamps; the last two are the tool's.
inline constexpr std::array<std::string_view, 8> cue_names{
    "ambient occlusion", "thin bone", "smooth silhouettes", "wet bone", "grain",
    "sawn faces",        "handpiece", "motion blur"};

/// The usual look with that cue or without it, the usual look for one of the tool's; std::invalid_argument
/// for another name.
SceneAppearance look_with(std::string_view cue, bool is_on);

struct CueCost {
    double without_ms = 0.0;     ///< of a frame, median
    double with_ms = 0.0;        ///< likewise
    double part_of_frame = 0.0;  ///< its share of a frame without it: the median of pairs that follow
                                 ///< one another
    double part_of_cpu = 0.0;  ///< the same of all threads' time, which others on the machine do not lengthen
    double changed_pixels = 0.0;  ///< share of the picture
};

/// Cost over so many pairs, at least one. Frames have the tool in the middle of the picture, half way to the
/// eye and seen from the side, if the cue is one of its own. Needs a current context.
CueCost cue_cost(std::string_view cue, const BoneTextures& bone, const Camera& camera,
                 const glm::ivec2& size_px, int pairs);

struct SilhouettePsnr {
    double without_db = 0.0;
    double with_db = 0.0;
    std::size_t pixels = 0;  ///< with a depth discontinuity of a millimetre or more
};

/// Peak signal-to-noise ratio on the pixels of silhouettes against a picture of 4 x 4 rays a pixel, each of
/// half the usual step. Needs a current context.
SilhouettePsnr silhouette_psnr(const BoneTextures& bone, const Camera& camera, const glm::ivec2& size_px);

}  // namespace osteomill::study
