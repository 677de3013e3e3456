#include "haptic_server/program/session_settings.h"

#include <fmt/format.h>

namespace osteomill {

nlohmann::ordered_json session_settings(const ServerOptions& options, const Scene& scene,
                                        const std::string& version) {
    const Burr& burr = scene.burrs.at(scene.start_burr);
    nlohmann::ordered_json json{{"version", version},
                                {"scene", scene.name},
                                {"force_model", options.session.force_model},
                                {"coupling", options.session.coupling},
                                {"device", options.device.entry->name},
                                {"grip", options.grip == Grip::light ? "light" : "firm"},
                                {"burr", burr.name},
                                {"rpm", 60.0 * burr.spindle_rev_per_s},
                                {"haptic_rate_hz", 1.0 / MillingSession::tick_s},
                                {"milling_rate_hz", options.session.milling_rate_hz},
                                {"clock", options.session.clock == ClockKind::real ? "real" : "virtual"},
                                {"vibration", options.session.vibration}};
    if (scene.force_scale != 1.0) json["force_scale"] = scene.force_scale;
    const auto add_file = [&](const char* key, const std::optional<std::filesystem::path>& file) {
        if (file) json[key] = file->filename().string();
    };
    add_file("bone", options.scene.bone);
    add_file("trajectory", options.scene.trajectory);
    add_file("controls", options.controls);
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
