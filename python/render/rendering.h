// A recording that is rendered, frame by frame, in the caller's process: frames of an image set and an OpenGL
// context of their own, which any thread may ask for the next.
#pragma once

#include <filesystem>
#include <functional>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>

#include "render_client/dataset/dataset_frames.h"
#include "render_client/volume/gl/offscreen_context.h"

namespace osteomill::python {

class Rendering {
  public:
    /// Throws gl::NoOpenGl, and the exceptions of DatasetFrames.
    Rendering(std::filesystem::path recording, DatasetContents contents);
    ~Rendering();
    Rendering(const Rendering&) = delete;
    Rendering& operator=(const Rendering&) = delete;

    struct Frame {
        DatasetFrame drawn;
        nlohmann::ordered_json instant;             ///< as the index has it (dataset_index.h)
        std::vector<nlohmann::ordered_json> views;  ///< a camera each
    };
    /// As DatasetFrames::next. One thread at a time; another waits.
    std::optional<Frame> next(const std::function<bool()>& stop_requested);

    /// Entries in the index of the sessions that have begun so far.
    nlohmann::ordered_json sessions();
    std::span<const DatasetCamera> cameras() const { return frames_->contents().cameras; }
    const DatasetImages& images() const { return frames_->contents().images; }

  private:
    std::mutex busy_;
    gl::OffscreenContext context_;
    nlohmann::ordered_json sessions_ = nlohmann::ordered_json::array();
    std::optional<DatasetFrames> frames_;
};

}  // namespace osteomill::python
