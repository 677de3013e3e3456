// The picture that render_client would draw if time were no object: rays in steps of a tenth of a voxel in
// double precision on the CPU, no skipping, no texture units. The model is that of the shaders: the surface
// of bone, its colours and opacities, the lights, the background. This picture is the exact form of the
// shaders' approximation; parts of the model (ambient occlusion from a coarse map, surface voxels) come from
// the same bytes.
#pragma once

#include "render_client/volume/camera.h"
#include "render_client/volume/picture.h"
#include "studies/render/reference_volume.h"

namespace osteomill::study {

struct ReferenceSettings {
    double step_voxels = 0.1;
    unsigned threads = 2;  ///< at least 1
};

Picture reference_image(const ReferenceVolume& volume, const Camera& camera, const glm::ivec2& size_px,
                        const ReferenceSettings& settings = {});

}  // namespace osteomill::study
