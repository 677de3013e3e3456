// render_client in a window of a real Wayland compositor, with a real server. See window_test.cpp for all
// that is alike under X11.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <thread>

#include "render_client/volume/picture.h"
#include "tests/support/picture_difference.h"
#include "tests/support/wayland_display.h"

namespace osteomill::testing {
namespace {

using namespace std::chrono_literals;
using Shell = WaylandDisplay::Shell;

constexpr const char* copier = "/usr/bin/wl-copy";
constexpr const char* paster = "/usr/bin/wl-paste";

class WaylandTest : public ::testing::TestWithParam<int> {
  protected:
    void SetUp() override {
        if (100 * GLFW_VERSION_MAJOR + GLFW_VERSION_MINOR < 304)
            GTEST_SKIP() << "GLFW " << GLFW_VERSION_MAJOR << "." << GLFW_VERSION_MINOR
                         << " shows its windows through X11: see WindowTest";
        if (const std::string missing = WaylandDisplay::missing(); !missing.empty())
            GTEST_SKIP() << "needs " << missing;
    }

    void start_server() {
        server_.emplace(
            std::vector<std::string>{HAPTIC_SERVER, "--listen", "127.0.0.1:0", "--device", "client"});
        const auto address = server_->address();
        ASSERT_TRUE(address) << server_->err();
        address_ = *address;
    }
    std::string folder(const std::string& name) const { return (folder_ / name).string(); }
    std::vector<std::string> client(const std::vector<std::string>& more) const {
        std::vector<std::string> command{RENDER_CLIENT, "--connect", address_, "--home", folder("kept")};
        command.insert(command.end(), more.begin(), more.end());
        return command;
    }
    /// A window's size that is so many pixels.
    static std::string units(int width_px, int height_px) {
        return std::to_string(width_px / GetParam()) + "x" + std::to_string(height_px / GetParam());
    }
    static bool comes_true(const std::function<bool()>& happened) {
        return eventually([&] {
            if (happened()) return true;
            std::this_thread::sleep_for(100ms);
            return false;
        });
    }
    /// Before it draws, the screen is black, as if a window filled it.
    void show_desktop(const glm::ivec2& size_px) {
        display_.emplace(size_px, GetParam(), Shell::desktop);
        ASSERT_TRUE(comes_true([&] { return free_part() > 0.9; }));
    }
    Picture screen() const { return display_->outside().screen(); }
    bool xdotool(const std::vector<std::string>& arguments) const {
        return display_->outside().xdotool(arguments);
    }
    void press(const std::string& key) const { ASSERT_TRUE(xdotool({"key", key})) << key; }
    bool shows(const Picture& wanted) const {
        return comes_true([&] { return difference(screen(), wanted) <= 0.01; });
    }
    bool shows_otherwise_than(const Picture& before, double at_least) const {
        return comes_true([&] { return difference(screen(), before) >= at_least; });
    }
    bool stands_still() const {
        return comes_true([&] {
            const Picture before = screen();
            std::this_thread::sleep_for(500ms);
            return difference(screen(), before) <= 0.003;
        });
    }

    /// The part of the screen that windows leave free.
    double free_part() const {
        const Picture picture = screen();
        std::size_t green = 0;
        for (std::size_t i = 0; i < picture.rgb.size(); i += 3)
            green += picture.rgb[i] == 0 && picture.rgb[i + 1] == 255 && picture.rgb[i + 2] == 0 ? 1 : 0;
        return 3.0 * static_cast<double>(green) / static_cast<double>(picture.rgb.size());
    }

    TemporaryFolder folder_;
    std::optional<ChildProcess> server_;
    std::string address_{"127.0.0.1:1"};  // nobody there
    std::optional<WaylandDisplay> display_;
    std::optional<ChildProcess> window_;
};

INSTANTIATE_TEST_SUITE_P(PixelsInAUnit, WaylandTest, ::testing::Values(1, 2),
                         [](const auto& scale) { return "Scale" + std::to_string(scale.param); });

TEST_P(WaylandTest, ShowsEveryPixelOfWhatAnOffscreenRunDrawsAndAnswersMouseAndKeys) {
    start_server();
    show_desktop({480, 360});
    const Finished offscreen =
        run_program(client({"--offscreen", "--frames", "3", "--no-panels", "--window-size", "480x360",
                            "--screenshots", folder("offscreen")}));
    ASSERT_EQ(offscreen.status, 0) << offscreen.err;
    const Picture first = read_png(folder("offscreen") + "/final.png");
    window_.emplace(display_->shown_here(client({"--no-panels", "--window-size", units(480, 360)})));
    ASSERT_TRUE(shows(first)) << difference(screen(), first) << window_->err();

    press("F1");
    EXPECT_TRUE(shows_otherwise_than(first, 0.2)) << "help";
    press("F1");
    EXPECT_TRUE(shows(first)) << "help goes again";
    ASSERT_TRUE(xdotool({"mousemove", "240", "180", "mousedown", "3"}));
    EXPECT_TRUE(comes_true([&] {
        xdotool({"mousemove_relative", "7", "2"});
        return difference(screen(), first) >= 0.1;
    })) << "the view turns";
    ASSERT_TRUE(xdotool({"mouseup", "3"}));
    press("Home");
    EXPECT_TRUE(shows(first)) << "the first view";
    ASSERT_TRUE(xdotool({"keydown", "w"}));
    EXPECT_TRUE(shows_otherwise_than(first, 0.01)) << "the burr moves";
    ASSERT_TRUE(xdotool({"keyup", "w"}));

    server_->send_signal(SIGINT);
    ASSERT_EQ(server_->wait(), 0);
    ASSERT_TRUE(stands_still());
    const Picture page = screen();
    press("Escape");
    EXPECT_TRUE(shows_otherwise_than(page, 0.005)) << "the page asks first";
    press("Return");
    EXPECT_EQ(window_->wait(), 0) << window_->err();
}

TEST_P(WaylandTest, DrawsAsManyPixelsAsItsWindowHasAfterItIsResized) {
    start_server();
    show_desktop({720, 540});
    const Finished offscreen =
        run_program(client({"--offscreen", "--frames", "3", "--no-panels", "--window-size", "720x540",
                            "--screenshots", folder("offscreen")}));
    ASSERT_EQ(offscreen.status, 0) << offscreen.err;
    const Picture whole = read_png(folder("offscreen") + "/final.png");
    window_.emplace(display_->shown_here(client({"--no-panels", "--window-size", units(480, 360)})));
    ASSERT_TRUE(comes_true([&] { return free_part() > 0.5 && free_part() < 0.6; })) << free_part();
    ASSERT_TRUE(stands_still());
    press("super+shift+m");  // weston's key: as large as the screen
    EXPECT_TRUE(shows(whole)) << difference(screen(), whole) << window_->err();
    press("F1");
    EXPECT_TRUE(shows_otherwise_than(whole, 0.1)) << "help";
    press("F1");
    EXPECT_TRUE(shows(whole)) << "help goes again";
}

TEST_P(WaylandTest, CutsCopiesAndPastesToAndFromOtherPrograms) {
    for (const char* program : {copier, paster})
        if (!std::filesystem::exists(program))
            GTEST_SKIP() << "needs " << program << " (apt-get install wl-clipboard)";
    std::filesystem::create_directories(folder("kept"));
    std::ofstream(folder("kept/window.toml")) << "tour_seen = true\n";
    show_desktop({1280, 800});
    window_.emplace(display_->shown_here(client({"--window-size", units(1280, 800)})));
    ASSERT_TRUE(comes_true([&] { return free_part() < 0.1; })) << window_->err();
    ASSERT_TRUE(stands_still());
    const auto other_program_has = [&](const std::string& text) {
        return comes_true([&] {
            return run_program(display_->shown_here({paster, "--no-newline"})).out == text;
        });
    };
    const auto press_and_wait = [&](const std::string& key) {
        press(key);
        EXPECT_TRUE(stands_still()) << key;
    };
    ChildProcess other_program(display_->shown_here({copier, "--foreground", "Zo\u00eb"}));
    ASSERT_TRUE(other_program_has("Zo\u00eb")) << other_program.err();
    // The trainee's name, at a place that is found at any scale.
    ASSERT_TRUE(xdotool({"mousemove", "380", GetParam() == 1 ? "618" : "596", "click", "1"}));
    press_and_wait("ctrl+a");
    press_and_wait("ctrl+v");
    press_and_wait("x");
    press_and_wait("ctrl+a");
    press_and_wait("ctrl+c");
    EXPECT_TRUE(other_program_has("Zo\u00ebx")) << window_->err();
    press_and_wait("End");
    press_and_wait("y");
    press_and_wait("ctrl+a");
    press_and_wait("ctrl+x");
    EXPECT_TRUE(other_program_has("Zo\u00ebxy")) << window_->err();
}

TEST_P(WaylandTest, EndsWhenAskedThoughItIsHidden) {
    start_server();
    display_.emplace(glm::ivec2(480, 360), GetParam(), Shell::kiosk);
    window_.emplace(display_->shown_here(
        client({"--no-panels", "--until-server-ends", "--window-size", units(480, 360)})));
    ASSERT_TRUE(comes_true([&] { return free_part() < 0.2; })) << window_->err();
    ASSERT_TRUE(stands_still());
    const Picture first = screen();
    ChildProcess in_front(
        display_->shown_here(client({"--no-panels", "--theme", "light", "--window-size", units(480, 360)})));
    ASSERT_TRUE(shows_otherwise_than(first, 0.2)) << in_front.err();
    server_->send_signal(SIGINT);
    ASSERT_EQ(server_->wait(), 0);
    EXPECT_EQ(window_->wait(), 0) << window_->err();
}

}  // namespace
}  // namespace osteomill::testing
