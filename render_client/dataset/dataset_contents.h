// Contents of an image set: its cameras, the moments of the recording that they show, and the kinds of
// images.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "render_client/dataset/camera_file.h"
#include "render_client/volume/scene_appearance.h"
#include "render_client/volume/textures/texture_plan.h"

namespace osteomill {

/// Which of a frame's images are made.
struct DatasetImages {
    bool colour = true;
    bool depth = true;
    bool labels = true;
    bool normals = true;
    bool ray_depth = false;

    bool has_surface() const { return depth || labels || normals || ray_depth; }
};

/// By their names: colour, depth, ray-depth, labels, normals. Throws std::invalid_argument for another.
DatasetImages images_named(std::span<const std::string> names);

/// Part `number` of `of`, 1 to `of`, for one process among several: every of-th frame.
struct DatasetPart {
    std::size_t number = 1;
    std::size_t of = 1;

    bool has(std::size_t frame) const { return frame % of == number - 1; }
};

/// The appearance of a window whose user changed nothing. With random looks the bone is wet only under the
/// random lamps.
inline SceneAppearance usual_look(bool is_by_lot) {
    SceneAppearance look;
    look.specular = is_by_lot ? 0.0f : usual_wetness;
    look.grain = look.neutral_sawn_faces = true;
    return look;
}

struct DatasetContents {
    std::vector<DatasetCamera> cameras = default_cameras();
    double from_s = 0.0;                   ///< recorded time from which on there are frames
    std::optional<double> frames_per_s{};  ///< in recorded time; absent: every recorded state
    DatasetImages images{};
    DatasetPart part{};
    std::optional<std::uint64_t> randomise{};  ///< seed of domain randomisation; absent: as in the window
    SceneAppearance look{};
    TextureLimits limits{};
};

}  // namespace osteomill
