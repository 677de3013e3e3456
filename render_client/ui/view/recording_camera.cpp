#include "render_client/ui/view/recording_camera.h"

#include <fmt/format.h>

#include <stdexcept>
#include <vector>

namespace osteomill {

RecordingCamera::RecordingCamera(const RenderOptions& options, const RecordingPlayer* player,
                                 const std::string& by_default)
    : player_(player) {
    const std::string& which = options.camera.empty() ? by_default : options.camera;
    if (which.empty()) return;
    const std::vector<DatasetCamera> cameras = cameras_named(which);
    if (cameras.size() != 1)
        throw std::runtime_error(
            fmt::format("{}: a recording is seen by one camera, not {}", which, cameras.size()));
    require_view(
        cameras, [&] { return player->has_view(); }, *options.replay);
    camera_ = cameras.front();
}

void RecordingCamera::aim(SessionPicture& session) {
    if (!camera_ || !session.has_bone() || aimed_at_s_ == player_->time_s()) return;
    session.reset_camera();
    if (player_->has_arrived()) aimed_at_s_ = player_->time_s();
    const std::optional<Viewpoint>& trainee = session.link().view;
    if (camera_->follows_trainee && !trainee) return;  // not yet
    look_through(session.camera(), camera_->pinhole_at(trainee),
                 camera_->pose_at(player_->time_s(), pose_of(session.camera()), trainee));
}

std::optional<glm::ivec2> RecordingCamera::size_px() const {
    if (!camera_ || camera_->follows_trainee) return std::nullopt;
    return camera_->pinhole.size_px;
}

}  // namespace osteomill
