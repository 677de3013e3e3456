#include "render_client/ui/view/kept_settings.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <exception>
#include <system_error>
#include <utility>
#include <vector>

#include "common/files/atomic_file.h"
#include "common/scene/scene_file.h"
#include "common/scene/toml_reader.h"
#include "common/scene/toml_text.h"
#include "common/words/translation.h"

namespace osteomill {

namespace {

const std::vector<std::string> theme_names{"dark", "light"};  // by ThemeName

/// Throws SceneError if something is wrong.
KeptSettings read_settings(const std::filesystem::path& file) {
    KeptSettings settings;
    const std::string name = file.string();
    const toml::table table = parse_toml(read_toml_text(file, "settings"), name);
    TomlReader reader(table, name, "the window's settings");
    const auto truth = [&](const char* key, bool& value) { value = reader.truth(key).value_or(value); };
    if (const auto theme = reader.choice("theme", theme_names))
        settings.theme = static_cast<ThemeName>(*theme);
    truth("sound", settings.sound);
    truth("warnings", settings.warns);
    truth("figures", settings.details_shown);
    truth("tour_seen", settings.tour_seen);
    reader.refuse_other_keys();
    return settings;
}

std::string text_of(const KeptSettings& settings) {
    return fmt::format(
        "# Settings of render_client's window: F2, F9, N, F12\n"
        "theme = \"{}\"\nsound = {}\nwarnings = {}\nfigures = {}\ntour_seen = {}\n",
        theme_names[static_cast<std::size_t>(settings.theme)], settings.sound, settings.warns,
        settings.details_shown, settings.tour_seen);
}

}  // namespace

SettingsFile::SettingsFile(std::filesystem::path file) : file_(std::move(file)) {
    std::error_code failed;
    if (!std::filesystem::exists(file_, failed)) return;
    try {
        settings_ = read_settings(file_);
    } catch (const SceneError& error) {
        wrong_ = trf("{}; settings are as usual, and none are kept until that is mended or the file removed",
                     error.what());
        is_unwritable_ = true;
    }
}

std::string SettingsFile::keep(const KeptSettings& settings) {
    if (settings == settings_ || is_unwritable_) return {};
    settings_ = settings;
    try {
        if (file_.has_parent_path()) std::filesystem::create_directories(file_.parent_path());
        write_atomic_file(file_, text_of(settings), Link::replace);
    } catch (const std::exception& error) {
        is_unwritable_ = true;
        return trf("settings are not kept: {}", error.what());
    }
    return {};
}

}  // namespace osteomill
