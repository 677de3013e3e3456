// The index of an image set, dataset.json: what lies where, in which units and conventions, and for each
// frame everything that is known of its instant.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "common/recording/playhead.h"
#include "render_client/dataset/session_images.h"
#include "render_client/ui/dataset_options.h"

namespace osteomill {

/// Position and rotation, mm and x, y, z, w: the order of most libraries.
nlohmann::ordered_json json_of(const Pose& pose);

class DatasetIndex {
  public:
    DatasetIndex(const std::filesystem::path& recording, const std::string& version,
                 std::span<const DatasetCamera> cameras, const DatasetOptions& options);

    /// Another session of the recording has begun: its scene and its table of labels.
    void begin_session(const SessionInfo& session, const Grid& grid);
    /// The instant of a playhead that has a tool; `images`: for each camera pose and files.
    void add_frame(std::size_t frame, const Playhead& playhead, nlohmann::ordered_json images);

    /// dataset.json or, of a part, dataset-2-of-8.json. Throws std::runtime_error naming the file where it
    /// cannot be written.
    void write() const;

  private:
    std::filesystem::path file_;
    nlohmann::ordered_json all_;
};

}  // namespace osteomill
