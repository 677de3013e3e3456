#include "render_client/ui/view/kept_settings.h"

#include <gmock/gmock.h>

#include <fstream>
#include <sstream>

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

TEST(KeptSettings, AreAsUsualWhereTheFileIsSpoiltWhichIsSaidAndStaysAsItIs) {
    const testing::TemporaryFolder folder;
    const auto file = folder / "window.toml";
    const auto wrong = [&](const std::string& text) {
        std::ofstream(file) << text;
        SettingsFile spoilt(file);
        EXPECT_EQ(spoilt.settings(), KeptSettings()) << text;
        EXPECT_EQ(spoilt.keep(others), "") << "it was said before";
        std::ostringstream after;
        after << std::ifstream(file).rdbuf();
        EXPECT_EQ(after.str(), text);
        return spoilt.wrong();
    };
    EXPECT_THAT(wrong("theme = "), HasSubstr("window.toml:1: not TOML: "));
    EXPECT_THAT(wrong("sound = true\ntheme = 'blue'\n"),
                HasSubstr("window.toml:2: 'theme' is \"blue\"; choose one of: dark, light; settings are as"));
    EXPECT_THAT(wrong("sound = 'loud'"), HasSubstr("window.toml:1: 'sound' must be true or false"));
    EXPECT_THAT(wrong("sund = true"), HasSubstr("sund"));
    EXPECT_THAT(wrong("[[[[[[[["), HasSubstr("not TOML"));
}

TEST(KeptSettings, ThatTheFileDoesNotSayAreAsUsual) {
    const testing::TemporaryFolder folder;
    const auto file = folder / "window.toml";
    std::ofstream(file) << "sound = true\n";
    SettingsFile settings(file);
    EXPECT_EQ(settings.wrong(), "");
    EXPECT_EQ(settings.settings(), KeptSettings{.sound = true});
    EXPECT_EQ(settings.keep(others), "");
    EXPECT_EQ(SettingsFile(file).settings(), others);
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
