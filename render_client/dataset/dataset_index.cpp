#include "render_client/dataset/dataset_index.h"

#include <fmt/format.h>

#include <glm/gtc/quaternion.hpp>

#include "common/files/atomic_file.h"
#include "common/program/commit.h"
#include "render_client/volume/gl/offscreen_context.h"

namespace osteomill {

namespace {

using Json = nlohmann::ordered_json;

Json json_of(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

Json intrinsics_of(const Pinhole& pinhole) {
    return Json::array({{pinhole.focal_px.x, 0.0, pinhole.centre_px.x},
                        {0.0, pinhole.focal_px.y, pinhole.centre_px.y},
                        {0.0, 0.0, 1.0}});
}

const Json conventions{
    {"world", "patient LPS: x to the patient's left, y to the back, z up; the patient does not move in it"},
    {"pose", "x, y, z in mm and the quaternion x, y, z, w: of a thing's own axes in the world"},
    {"camera",
     "x right, y down, z forward; pixel (0, 0) is the middle of the upper left one; u = fx X / Z + cx"},
    {"tool", "origin at the burr's centre, z along the spindle from tip to shank"},
    {"depth", "float32 (height, width), mm along the camera's z; inf where there is nothing"},
    {"ray_depth", "float32 (height, width), mm from the camera's centre; inf where there is nothing"},
    {"labels", "8 bits, indices into the session's labels"},
    {"normals",
     "float16 (height, width, 3), unit, out of the surface, the camera's axes; 0 where there is nothing"},
    {"colour", "8-bit sRGB"},
    {"force_n", "on the hand, world axes, N"},
    {"removed_mm3", "bone that was taken since the session began"},
};

/// Position and rotation, mm and x, y, z, w: the order of most libraries.
Json json_of(const Pose& pose) {
    return {pose.position_mm.x, pose.position_mm.y, pose.position_mm.z, pose.rotation.x,
            pose.rotation.y,    pose.rotation.z,    pose.rotation.w};
}

std::string name_of_index(const DatasetPart& part) {
    return part.of == 1 ? "dataset.json" : fmt::format("dataset-{}-of-{}.json", part.number, part.of);
}

}  // namespace

Json json_of(const DatasetCamera& camera) {
    return {{"name", camera.name},
            {"width_px", camera.pinhole.size_px.x},
            {"height_px", camera.pinhole.size_px.y},
            {"intrinsics", camera.has_trainees_angle ? Json() : intrinsics_of(camera.pinhole)}};
}

Json session_json(const ImagedSession& drawn) {
    const SessionInfo& session = drawn.session();
    Json labels = Json::array();
    for (const SurfaceLabel& label : label_table(session.tissues))
        labels.push_back({{"name", label.name}, {"rgb", label.colour_rgb}});
    return {{"scene", session.scene_name},
            {"case", session.case_name},
            {"server_version", session.server_version},
            {"voxel_mm", drawn.bone().grid().spacing_mm},
            {"labels", labels}};
}

Json instant_json(const DatasetFrame& frame, const ImagedSession& drawn) {
    const ToolState& state = *drawn.tool();
    const SessionInfo& session = drawn.session();
    const glm::dmat4 pose = pose_of(tool_as_thing(state, session));
    Json tool{{"pose", json_of(pose_of(glm::dvec3(pose[3]), glm::dmat3(pose)))}};
    if (const Burr* burr = session.burr_of(state.burr)) {
        tool["burr"] = burr->name;
        tool["diameter_mm"] = burr->diameter_mm;
        tool["spindle_rpm"] = state.spindle_on ? spindle_rpm(state, *burr) : 0.0;
    }
    return {{"frame", frame.number},
            {"session", frame.session},
            {"recorded_s", drawn.time_s()},
            {"session_s", state.time_s},
            {"tool", tool},
            {"hand_mm", json_of(state.hand_position_mm)},
            {"force_n", json_of(state.force_n)},
            {"removed_mm3", state.removed_mm3}};
}

Json view_json(const DatasetFrame& frame, std::size_t camera, const DatasetCamera& its) {
    const CameraImages& images = frame.images[camera];
    Json view{{"camera", its.name}, {"pose", json_of(images.camera)}};
    if (its.has_trainees_angle) view["intrinsics"] = intrinsics_of(images.pinhole);
    if (camera < frame.looks.size()) view["look"] = json_of(frame.looks[camera]);
    return view;
}

DatasetIndex::DatasetIndex(const std::filesystem::path& folder, const std::string& recording,
                           const std::string& version, const DatasetContents& contents)
    : file_(folder / name_of_index(contents.part)) {
    all_ = {{"osteomill", version},
            {"commit", built_from_commit()},
            {"recording", recording},
            {"gl_renderer", gl::renderer_name()},
            {"randomised_from", contents.randomise ? Json(*contents.randomise) : Json()},
            {"conventions", conventions},
            {"cameras", Json::array()},
            {"sessions", Json::array()},
            {"frames", Json::array()}};
    for (const DatasetCamera& camera : contents.cameras) all_["cameras"].push_back(json_of(camera));
}

void DatasetIndex::add_frame(const DatasetFrame& frame, const ImagedSession& drawn, Json images) {
    Json all = instant_json(frame, drawn);
    all["images"] = std::move(images);
    all_["frames"].push_back(std::move(all));
}

void DatasetIndex::write() const {
    write_atomic_file(file_, all_.dump() + "\n");
}

}  // namespace osteomill
