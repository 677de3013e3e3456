#include "render_client/ui/view/kept_settings.h"

#include <gmock/gmock.h>

#include <fstream>

#include "tests/support/temporary_folder.h"

namespace osteomill {
namespace {

using ::testing::HasSubstr;

const KeptSettings others{
    .theme = ThemeName::light, .sound = true, .warns = false, .details_shown = true, .tour_seen = true};

TEST(KeptSettings, AreThereAgain) {
    const testing::TemporaryFolder folder;
    const auto file = folder / "home/window.toml";
    SettingsFile first(file);
    EXPECT_EQ(first.settings(), KeptSettings());
    EXPECT_EQ(first.keep(KeptSettings()), "");
    EXPECT_FALSE(std::filesystem::exists(file)) << "nothing was changed";
    EXPECT_EQ(first.keep(others), "");
    EXPECT_EQ(SettingsFile(file).settings(), others);
}

TEST(KeptSettings, AreAsUsualWhereTheFileIsNone) {
    const testing::TemporaryFolder folder;
    const auto file = folder / "window.toml";
    for (const std::string text : {"", "theme = ", "theme = 3\nsound = 'loud'", "[[[[[[[["}) {
        std::ofstream(file) << text;
        EXPECT_EQ(SettingsFile(file).settings(), KeptSettings()) << text;
    }
    std::ofstream(file) << "sound = true\nof_a_later_version = 1\n";
    EXPECT_TRUE(SettingsFile(file).settings().sound);
}

TEST(KeptSettings, ThatCannotBeKeptAreSaidOnce) {
    const testing::TemporaryFolder folder;
    std::ofstream(folder / "home") << "a file, no folder";
    SettingsFile settings(folder / "home/window.toml");
    EXPECT_THAT(settings.keep(others), HasSubstr("settings are not kept: "));
    EXPECT_EQ(settings.keep(KeptSettings()), "");
}

}  // namespace
}  // namespace osteomill
