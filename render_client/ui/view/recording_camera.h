// The camera through which a recording is seen: the trainee's eyes as they were recorded, or one of a file.
#pragma once

#include <optional>

#include "render_client/dataset/camera_file.h"
#include "render_client/link/recording_player.h"
#include "render_client/ui/options.h"
#include "render_client/ui/view/session_picture.h"

namespace osteomill {

class RecordingCamera {
  public:
    /// The one that --camera names; if it is not given, `by_default` says which (as cameras_named has it),
    /// and nothing is the person's own view. Throws std::runtime_error, in one line, if there are several, or
    /// the recording does not state the trainee's viewpoint.
    RecordingCamera(const RenderOptions& options, const RecordingPlayer* player,
                    const std::string& by_default = {});

    /// Turns the picture's camera to where this one is at the recording's time. While that stands still it
    /// is the person's to turn.
    void aim(SessionPicture& session);

    /// The size of its pictures, if its file states it.
    std::optional<glm::ivec2> size_px() const;

  private:
    const RecordingPlayer* player_;
    std::optional<DatasetCamera> camera_;
    std::optional<double> aimed_at_s_;
};

}  // namespace osteomill
