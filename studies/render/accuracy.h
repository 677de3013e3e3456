// Speed against accuracy of pictures: for each way to draw a bone the time of a frame and how far the picture
// is from the reference image.
#pragma once

#include <string>
#include <vector>

#include "analysis/output/table.h"
#include "render_client/volume/passes/raycast_renderer.h"
#include "render_client/volume/passes/renderer_choice.h"
#include "studies/render/reference_image.h"
#include "studies/render/timed_drawing.h"
#include "studies/render/trial_bone.h"

namespace osteomill::study {

/// A way to draw.
struct DrawingSetting {
    std::string family{};  ///< what it belongs to in the chart: "raycast, gradient" ...
    std::string label{};   ///< what tells it from the others of its family: "step 0.75" ...
    RendererChoice renderer = RendererChoice::raycast;
    ShadingSettings look{};
    float step_voxels = RaycastSettings{}.step_voxels;  ///< of rays, or between slices
    bool skips = true;                                  ///< of rays: empty space
    int divisor = 1;          ///< width and height are divided by it and the picture is scaled up again
    bool is_default = false;  ///< what render_client does by default
};

/// Every axis of choice by itself, from the default; fewer where `quick`.
std::vector<DrawingSetting> drawing_settings(bool quick);

/// How fast a setting draws, and how near to the reference.
struct Drawn {
    Cost frame{};
    double psnr_db = 0.0;
    double ssim = 0.0;
};
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Drawn, frame, psnr_db, ssim)

struct DrawingPoint {
    std::string bone{};
    std::string view{};  ///< "overview" or "close-up"
    DrawingSetting setting{};
    Drawn drawn{};
};

/// Settings of one look, which have a reference together.
std::vector<std::vector<DrawingSetting>> by_look(const std::vector<DrawingSetting>& settings);

/// Draws a view of a bone in settings of one look. Needs a current OpenGL context.
std::vector<Drawn> measure(const TrialBone& trial, const Camera& camera,
                           const std::vector<DrawingSetting>& settings, const glm::ivec2& size_px, bool quick);

Table table_of(const std::vector<DrawingPoint>& points);

}  // namespace osteomill::study
