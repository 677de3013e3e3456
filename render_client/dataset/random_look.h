// Domain randomisation: the same surfaces under other lamps, of other colours, wet or dry, by another camera.
//
// Every pixel's surface is known, so that its light is made anew from its normal: the light that the scene's
// lamps reflect from it is replaced by that of turned and tinted lamps (lighting.h), times a tint of its
// label, and a wet tissue has their highlights (Blinn). Shadows stay. The camera then exposes, blurs by a
// Gaussian, and adds noise of variance read^2 + shot * light, in linear light (Foi et al. 2008, IEEE Trans.
// Image Process. 17).
//
// The random values follow from seed, frame and camera alone. Lamps, tints and wetness are a frame's, the
// same for all cameras; depth, labels and normals stay as they are.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <vector>

#include "render_client/dataset/session_images.h"

namespace osteomill {

struct RandomLook {
    // The scene's, in this frame.
    glm::dquat lamps{1.0, 0.0, 0.0, 0.0};  ///< turns them, up to 50 degrees
    glm::dvec3 lamp_rgb{1.0};              ///< times their light, 0.85 to 1.15 each
    double wetness = 0.0;                  ///< strength of highlights, 0 to 0.8
    std::vector<glm::dvec3>
        tint_by_label{};  ///< 0.8 to 1.2 in all, 0.93 to 1.07 a channel; the tool has none
    // The camera's.
    double exposure = 1.0;    ///< 0.7 to 1.4
    double blur_px = 0.0;     ///< standard deviation, 0 to 1
    double read_noise = 0.0;  ///< as a share of light 1, 0.001 to 0.01
    double shot_noise = 0.0;  ///< variance a light, 0 to 0.0006
    std::uint64_t noise_seed = 0;
};

/// Drawn by lot.
RandomLook random_look(std::uint64_t seed, std::size_t frame, std::size_t camera, std::size_t labels);

/// The colour picture as it looks then.
Picture looked_at(const CameraImages& images, const Pinhole& pinhole, const RandomLook& look);

/// For the index: all but the noise's seed.
nlohmann::ordered_json json_of(const RandomLook& look);

}  // namespace osteomill
