// A task for who draws: which phantom, from where, how large, how many frames. The same for render_client's
// own drawing and, as JSON, for a program that has another library draw.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "render_client/volume/camera.h"

namespace osteomill::study {

enum class Motion {
    orbit,  ///< the view turns, nothing changes
    carve   ///< the view is still, the 5 mm burr cuts
};
inline constexpr std::array<const char*, 2> motion_names{"orbit", "carve"};
inline constexpr double orbit_rad_a_frame = 0.03;

struct DrawingTask {
    std::string phantom{};
    glm::ivec2 size_px{0};
    int frames = 0;  ///< of each motion
    Camera first_view{};
};

nlohmann::ordered_json json_of(const DrawingTask& task);
/// Throws nlohmann::json::exception where a key is missing or of another kind.
DrawingTask task_of(const nlohmann::ordered_json& json);

}  // namespace osteomill::study
