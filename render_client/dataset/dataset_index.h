// The index of an image set, dataset.json: what lies where, in which units and conventions, and for each
// frame everything that is known of its instant.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "render_client/dataset/dataset_frames.h"
#include "render_client/dataset/drawn_session.h"

namespace osteomill {

// What the index says of a camera, of a session, of a frame and of one of its
// cameras; units and conventions are the index's.

/// Name, size and intrinsics; null for these where they change from frame to frame.
nlohmann::ordered_json json_of(const DatasetCamera& camera);
nlohmann::ordered_json session_json(const DrawnSession& drawn);
/// All but its images: time, tool, hand, force, removed volume. The session has a tool.
nlohmann::ordered_json instant_json(const DatasetFrame& frame, const DrawnSession& drawn);
/// Of camera number `camera`: name, pose, intrinsics if those are the frame's, and the look by lot.
nlohmann::ordered_json view_json(const DatasetFrame& frame, std::size_t camera, const DatasetCamera& its);

class DatasetIndex {
  public:
    /// In `folder`; of a recording's name, by the program of that version.
    DatasetIndex(const std::filesystem::path& folder, const std::string& recording,
                 const std::string& version, const DatasetContents& contents);

    /// Another session of the recording has begun.
    void begin_session(const DrawnSession& drawn) { all_["sessions"].push_back(session_json(drawn)); }
    /// `images`: for each camera view_json and files.
    void add_frame(const DatasetFrame& frame, const DrawnSession& drawn, nlohmann::ordered_json images);

    /// dataset.json or, of a part, dataset-2-of-8.json. Throws std::runtime_error naming the file where it
    /// cannot be written.
    void write() const;

  private:
    std::filesystem::path file_;
    nlohmann::ordered_json all_;
};

}  // namespace osteomill
