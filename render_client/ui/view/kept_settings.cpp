#include "render_client/ui/view/kept_settings.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <exception>
#include <string_view>

#include "common/files/atomic_file.h"
#include "common/scene/shallow_toml.h"
#include "render_client/ui/words/translation.h"

namespace osteomill {

namespace {

constexpr std::string_view light = "light";

KeptSettings read_settings(const std::filesystem::path& file) {
    KeptSettings settings;
    try {
        const std::string text = read_toml_text(file, "settings");
        require_shallow_toml(text, file.string());
        const toml::table table = toml::parse(text);
        const auto truth = [&](const char* key, bool& value) { value = table[key].value_or(value); };
        if (table["theme"].value_or(std::string_view()) == light) settings.theme = ThemeName::light;
        truth("sound", settings.sound);
        truth("warnings", settings.warns);
        truth("figures", settings.details_shown);
        truth("tour_seen", settings.tour_seen);
    } catch (const std::exception&) {
        return settings;
    }
    return settings;
}

std::string text_of(const KeptSettings& settings) {
    return fmt::format(
        "# Of render_client's window: F2, F9, N, F12\n"
        "theme = \"{}\"\nsound = {}\nwarnings = {}\nfigures = {}\ntour_seen = {}\n",
        settings.theme == ThemeName::light ? light : "dark", settings.sound, settings.warns,
        settings.details_shown, settings.tour_seen);
}

}  // namespace

SettingsFile::SettingsFile(std::filesystem::path file)
    : file_(std::move(file)), settings_(read_settings(file_)) {}

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
