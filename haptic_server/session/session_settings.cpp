#include "haptic_server/session/session_settings.h"

#include <fmt/format.h>

#include <numeric>
#include <variant>

#include "common/program/commit.h"
#include "common/scene/scene_file.h"
#include "haptic_server/session/recorded_arm.h"
#include "simulation/carving/instruction_set.h"

namespace osteomill {

namespace {

std::string hex(std::uint64_t digest) {
    return fmt::format("{:016x}", digest);
}

nlohmann::ordered_json numbers(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

}  // namespace

nlohmann::ordered_json session_settings(const MillingSessionOptions& milling, const SceneChoice& choice,
                                        const SessionScene& of_session, const HandSettings& hand,
                                        std::string_view version) {
    const Scene& scene = of_session.scene;
    const SceneDigests& digests = of_session.digests;
    const Burr& burr = scene.burrs.at(scene.start_burr);
    nlohmann::ordered_json json{
        {"version", version},
        {"commit", built_from_commit()},
        {"scene", scene.name},
        {"force_model", milling.force_model},
        {"coupling", name_of(milling.coupling)},
        {"device", hand.device},
        {"grip", name_of(hand.grip)},
        {"burr", burr.name},
        {"rpm", 60.0 * burr.spindle_rev_per_s},
        {"haptic_rate_hz", 1.0 / MillingSession::tick_s},
        {"milling_rate_hz", milling.milling_rate_hz},
        {"clock", milling.clock == ClockKind::real ? "real" : "virtual"},
        {"vibration", milling.vibration},
        {"wall_friction", scene.wall_friction},
        {"start_position_mm", numbers(scene.start_pose.position_mm)},
        {"start_spindle_axis", numbers(scene.start_pose.spindle_axis)},
        {"bone_digest", hex(digests.bone)},
        {"structures_digest", hex(digests.structures)},
        {"is_built_in", !digests.scene_file && !choice.bone},
        {"arm", arm_settings(hand.arm)},
        {"removed_before_mm3", std::accumulate(of_session.source.removed_before_mm3.begin(),
                                               of_session.source.removed_before_mm3.end(), 0.0)},
        {"instruction_set", name_of(best_instruction_set())},
        {"seeds", "none: nothing is drawn at random"}};
    if (digests.scene_file) json["case_digest"] = hex(*digests.scene_file);
    if (scene.force_scale != 1.0) json["force_scale"] = scene.force_scale;
    const auto add_file = [&](const char* key, const std::optional<std::filesystem::path>& file) {
        if (file) json[key] = file->filename().string();
    };
    add_file("bone", choice.bone);
    add_file("trajectory", choice.trajectory);
    if (digests.trajectory) json["trajectory_digest"] = hex(*digests.trajectory);
    return json;
}

std::map<std::string, std::string> as_texts(const nlohmann::ordered_json& settings) {
    std::map<std::string, std::string> texts;
    // A file's name may hold bytes that no message takes.
    const auto valid = nlohmann::ordered_json::parse(
        settings.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
    for (const auto& [name, value] : valid.items())
        texts[name] = value.is_string()         ? value.get<std::string>()
                      : value.is_number_float() ? fmt::format("{}", value.get<double>())
                                                : value.dump();
    return texts;
}

std::string effective_scene_text(Scene scene) {
    if (auto* file = std::get_if<FileSource>(&scene.bone)) {
        file->path = file->path.filename();
        file->segmentation = file->segmentation.filename();
    }
    if (auto* file = std::get_if<std::filesystem::path>(&scene.trajectory.source)) *file = file->filename();
    return write_scene(scene, SceneText::complete);
}

}  // namespace osteomill
