#include "haptic_server/session/shown_session.h"

#include <fmt/format.h>

#include <chrono>
#include <thread>
#include <utility>

#include "analysis/surface/mesh_file.h"
#include "analysis/surface/surface_mesh.h"
#include "common/files/atomic_file.h"
#include "common/log/log.h"
#include "common/wire/ct_pieces.h"
#include "common/wire/frame.h"
#include "haptic_server/session/tool_place.h"
#include "imaging/case/structures.h"
#include "simulation/loop/clearance.h"

namespace osteomill {

namespace {

constexpr std::size_t longest_scene_text = largest_frame_bytes / 2;

/// Under a name that nobody gave: a link of that name is replaced.
void save_surface(const std::filesystem::path& path, const Bone& bone) {
    const SurfaceMesh mesh = surface_of(bone);
    if (mesh.triangles.empty()) throw std::runtime_error("nothing is left of the bone");
    write_mesh(path, mesh, Link::replace);
}

SaveAndFinish::Save save_into(const OutputPlace* place, const BoneSource& source) {
    if (place == nullptr) return {};
    return [place, &source](const Bone& now, const std::string& mesh_ending) -> std::string {
        try {
            std::filesystem::path file = place->now();
            if (mesh_ending.empty())
                save_bone(file, source, now);
            else
                save_surface(file.replace_extension(mesh_ending), now);
        } catch (const SavedWithoutCt& error) {
            return error.what();
        } catch (const std::exception& error) {
            return fmt::format("the bone was not saved: {}", error.what());
        }
        return {};
    };
}

SessionInfo info_of(const ShownOptions& options, const SessionScene& scene, const Grid& grid,
                    const DeviceParts& device) {
    SessionInfo info = session_info(scene.scene, device.operator_channel != nullptr,
                                    device.device->limits().max_force_n, options.version);
    info.has_ct = has_ct(scene.source, grid);
    info.accepts_controls = options.accepts_controls;
    info.trainee = options.trainee;
    info.case_name = options.case_name;
    info.settings = options.settings;
    // A hello has one frame; a scene of a thousand tissues does not fit.
    if (options.scene_toml.size() <= longest_scene_text) info.scene_toml = options.scene_toml;
    return info;
}

/// Clients see that the recording stands still.
StreamingOptions heard_by(SaveAndFinish& keeper, StreamingOptions streaming) {
    if (streaming.record)
        streaming.record->on_news = [&keeper](RecordingNews news, const std::string& line) {
            keeper.hear(news, line);
        };
    return streaming;
}

}  // namespace

ShownSession::ShownSession(ShownOptions options, SessionScene& scene, Bone mirror, MillingSession& session,
                           const DeviceParts& device)
    : waits_for_client_(options.streaming.waits_for_client),
      keeper_(save_into(options.save_bone, scene.source)),
      controls_(session.exchange().gate, *session.exchange().restored, session.exchange().placements,
                requests(options, scene.scene, device, session.held_fixtures())),
      live_(session.exchange().tool, session.exchange().changes, &controls_, std::move(options.script)),
      server_(heard_by(keeper_, options.streaming), info_of(options, scene, session.bone().grid(), device),
              std::move(mirror), live_, device.operator_channel.get(),
              structures_outside_bone_labels(scene.structures, scene.scene, session.bone())) {
    live_.listen_to(session.exchange().cuts);
    if (has_ct(scene.source, session.bone().grid()))
        live_.offer_ct([&source = scene.source] { return ct_of(source, most_ct_voxels); });
    live_.watch(StructureWatch(std::move(scene.structures), scene.scene.tissues, scene.scene.burrs),
                scene.scene.tissues);
    server_.start();
}

void ShownSession::wait_for_client(const std::atomic<bool>& stop) const {
    if (!waits_for_client_) return;
    log_info("the session begins when a client has drawn the bone");
    while (!server_.has_client_begun() && !stop.load() && !finish_requested())
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    if (!server_.has_client_begun()) log_info("the session has not begun: no client drew the bone");
}

void ShownSession::end() {
    server_.end();
    keeper_.wait();
}

ControlRunner::Requests ShownSession::requests(const ShownOptions& options, const Scene& scene,
                                               const DeviceParts& device, FixtureSet held) {
    ControlRunner::Requests requests = keeper_.requests();
    for (std::size_t i = 0; i < scene.fixtures.size(); ++i)
        requests.fixtures.push_back(has_fixture(held, i) ? scene.fixtures[i].name : std::string());
    requests.finish_words = options.words_at_finish;
    if (device.simulated == nullptr) {
        requests.place = [&burrs = scene.burrs](const Bone& bone, const ToolPose& place, std::size_t burr) {
            return clear_place(bone, burr_hull(burrs[burr]), place);
        };
        requests.lift_out = [&burrs = scene.burrs](const Bone& bone, const ToolPose& at, std::size_t burr) {
            return lifted_out(bone, burr_hull(burrs[burr]), at);
        };
    }
    requests.placed = [this](const ToolPose& pose) { placed_ = pose; };
    return requests;
}

}  // namespace osteomill
