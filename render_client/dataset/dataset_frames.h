// The frames of an image set, one after the other, in memory. run_dataset (render_client/ui) writes them, and
// Python gets them.
//
// Nothing depends on the time that it takes: the same recording and contents give the same bits on one
// machine.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "common/recording/playhead.h"
#include "render_client/dataset/dataset_contents.h"
#include "render_client/dataset/imaged_session.h"
#include "render_client/dataset/random_look.h"
#include "render_client/dataset/session_images.h"

namespace osteomill {

struct DatasetFrame {
    std::size_t number = 0;  ///< counted over all parts, from 0
    std::size_t session = 0;
    std::vector<CameraImages> images{};  ///< a camera each
    std::vector<RandomLook> looks{};     ///< a camera each; none without domain randomisation
};

/// Frame `number`, of the instant that `images` followed last.
DatasetFrame draw_frame(SessionImages& images, const DatasetContents& contents, std::size_t number,
                        const ImagedSession& session);

class DatasetFrames {
  public:
    /// `on_session` is called whenever one begins, the first from here. Throws RecordingError, and
    /// std::runtime_error, in one line, for a bone that cannot be drawn and for a camera that follows a
    /// trainee whose viewpoint the recording does not state. All calls, and the end of this, need an OpenGL
    /// context current, the same.
    DatasetFrames(std::filesystem::path recording, DatasetContents contents,
                  std::function<void(const ImagedSession&)> on_session);

    /// The next frame of this part; nothing at the end of the recording, or once `stop_requested`, asked at
    /// every state, returns true. Throws RecordingError if it cannot be read.
    std::optional<DatasetFrame> next(const std::function<bool()>& stop_requested);

    /// The instant of the last frame.
    const Playhead& playhead() const { return playhead_; }
    const ImagedSession& session() const { return drawn_; }
    const DatasetContents& contents() const { return contents_; }
    const BoneTextures& textures() const { return images_->textures(); }
    /// Among all parts' frames so far.
    std::size_t count() const { return count_; }

  private:
    void begin_session();
    bool has_more_of_this_instant() const;
    bool is_due();

    DatasetContents contents_;
    std::function<void(const ImagedSession&)> on_session_;
    Playhead playhead_;
    DrawnRecording drawn_{playhead_};
    std::optional<SessionImages> images_;
    std::size_t sessions_ = 0;
    std::size_t count_ = 0;
    double period_ = -std::numeric_limits<double>::infinity();
};

}  // namespace osteomill
