#include "haptic_server/session/session_settings.h"

#include <fmt/format.h>

namespace osteomill {

nlohmann::ordered_json session_settings(const MillingSessionOptions& milling, const SceneChoice& choice,
                                        const Scene& scene, const std::string& device,
                                        std::optional<Grip> grip, const std::string& version) {
    const Burr& burr = scene.burrs.at(scene.start_burr);
    nlohmann::ordered_json json{{"version", version},
                                {"scene", scene.name},
                                {"force_model", milling.force_model},
                                {"coupling", milling.coupling},
                                {"device", device},
                                {"grip", name_of(grip)},
                                {"burr", burr.name},
                                {"rpm", 60.0 * burr.spindle_rev_per_s},
                                {"haptic_rate_hz", 1.0 / MillingSession::tick_s},
                                {"milling_rate_hz", milling.milling_rate_hz},
                                {"clock", milling.clock == ClockKind::real ? "real" : "virtual"},
                                {"vibration", milling.vibration}};
    if (scene.force_scale != 1.0) json["force_scale"] = scene.force_scale;
    const auto add_file = [&](const char* key, const std::optional<std::filesystem::path>& file) {
        if (file) json[key] = file->filename().string();
    };
    add_file("bone", choice.bone);
    add_file("trajectory", choice.trajectory);
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

}  // namespace osteomill
