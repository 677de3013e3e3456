// The index of an image set, dataset.json: its files, their units and conventions, and for each frame all
// facts of its instant.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "render_client/dataset/dataset_frames.h"
#include "render_client/dataset/imaged_session.h"

namespace osteomill {

// The index's entries for a camera, for a session, for a frame and for one of its
// cameras; units and conventions are the index's.

/// Name, size and intrinsics; null for these if they change from frame to frame.
nlohmann::ordered_json json_of(const DatasetCamera& camera);
nlohmann::ordered_json session_json(const ImagedSession& drawn);
/// All but its images: time, tool, hand, force, removed volume. The session has a tool.
nlohmann::ordered_json instant_json(const DatasetFrame& frame, const ImagedSession& drawn);
/// The entry of camera number `camera`: name, pose, intrinsics if those are the frame's, and the random
/// appearance.
nlohmann::ordered_json view_json(const DatasetFrame& frame, std::size_t camera, const DatasetCamera& its);

class DatasetIndex {
  public:
    /// Begins the index in `folder` of the recording of that name, written by the program of that version.
    DatasetIndex(const std::filesystem::path& folder, const std::string& recording,
                 const std::string& version, const DatasetContents& contents);

    /// Another session of the recording has begun.
    void begin_session(const ImagedSession& drawn) { all_["sessions"].push_back(session_json(drawn)); }
    /// `images`: for each camera view_json and files.
    void add_frame(const DatasetFrame& frame, const ImagedSession& drawn, nlohmann::ordered_json images);

    /// dataset.json or, of a part, dataset-2-of-8.json. Throws std::runtime_error naming the file if it
    /// cannot be written.
    void write() const;

  private:
    std::filesystem::path file_;
    nlohmann::ordered_json all_;
};

}  // namespace osteomill
