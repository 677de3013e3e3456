// render_client in a real window, with a real server: mouse and keys, the picture on the screen, and a
// display that fails. Needs Xvfb and xdotool.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "common/recording/playhead.h"
#include "render_client/volume/picture.h"
#include "tests/support/block_file.h"
#include "tests/support/logged_removal.h"
#include "tests/support/picture_difference.h"
#include "tests/support/virtual_display.h"

namespace osteomill::testing {
namespace {

using namespace std::chrono_literals;
using ::testing::AllOf;
using ::testing::HasSubstr;

const glm::ivec2 size_px(480, 360);

int lines_of(const std::string& text) {
    return static_cast<int>(std::count(text.begin(), text.end(), '\n'));
}

class WindowTest : public ::testing::Test {
  protected:
    void SetUp() override {
        if (const std::string missing = VirtualDisplay::missing(); !missing.empty())
            GTEST_SKIP() << "needs " << missing;
        display_.emplace(size_px);
    }

    void start_server(const std::vector<std::string>& more = {}) {
        std::vector<std::string> command{HAPTIC_SERVER, "--listen", "127.0.0.1:0", "--device", "client"};
        command.insert(command.end(), more.begin(), more.end());
        server_.emplace(command);
        const auto address = server_->address();
        ASSERT_TRUE(address) << server_->err();
        address_ = *address;
    }
    /// For a server that the window starts.
    void find_a_free_port() {
        write_block(folder("block.nrrd"));
        start_server({"--bone", folder("block.nrrd")});
        server_->send_signal(SIGINT);
        ASSERT_TRUE(server_->wait());
    }

    std::string folder(const std::string& name) const { return (folder_ / name).string(); }
    std::vector<std::string> client(const std::vector<std::string>& more) const {
        std::vector<std::string> command{RENDER_CLIENT,
                                         "--connect",
                                         address_,
                                         "--home",
                                         folder("kept"),
                                         "--window-size",
                                         std::to_string(size_px.x) + "x" + std::to_string(size_px.y)};
        command.insert(command.end(), more.begin(), more.end());
        return command;
    }
    /// A window whose picture is on the screen, with the keyboard.
    void open_window(const std::vector<std::string>& more) {
        window_.emplace(display_->shown_here(client(more)));
        ASSERT_TRUE(
            display_->xdotool({"search", "--sync", "--onlyvisible", "--name", "^Osteomill$", "windowfocus"}))
            << window_->err();
        ASSERT_TRUE(comes_true([&] { return shows_bone(display_->screen()); })) << window_->err();
    }
    /// By the dark margin at the left of its panel, in a window of 1280 x 800.
    static bool shows_start_page(const Picture& screen) {
        const auto* pixel = screen.at(41, 400);
        return std::max({pixel[0], pixel[1], pixel[2]}) < 45;
    }
    /// By its warm colours, wherever they are: a panel or the pointer may cover any one place.
    static bool shows_bone(const Picture& screen) {
        std::size_t warm = 0;
        for (std::size_t i = 0; i < screen.rgb.size(); i += 3)
            warm += screen.rgb[i] > 90 && screen.rgb[i] > screen.rgb[i + 2] ? 1 : 0;
        return warm > screen.rgb.size() / 3 / 20;
    }
    /// A sanitizer on a busy machine draws a frame a second.
    static bool comes_true(const std::function<bool()>& happened) {
        return eventually([&] {
            if (happened()) return true;
            std::this_thread::sleep_for(100ms);
            return false;
        });
    }
    /// Waits until the requested view is on the screen, and nothing moves there but figures and a cursor of
    /// text.
    bool stands_still() const {
        return comes_true([&] {
            const Picture before = display_->screen();
            std::this_thread::sleep_for(500ms);
            return difference(display_->screen(), before) <= 0.003;
        });
    }
    /// The key opens a field to type into.
    void press_and_see(const std::string& key) const {
        const Picture before = display_->screen();
        press(key);
        ASSERT_TRUE(shows_otherwise_than(before, 0.005)) << key;
        ASSERT_TRUE(stands_still()) << key;
    }
    bool shows(const Picture& wanted, double at_most = 0.01) const {
        return comes_true([&] { return difference(display_->screen(), wanted) <= at_most; });
    }
    bool shows_otherwise_than(const Picture& before, double at_least) const {
        return comes_true([&] { return difference(display_->screen(), before) >= at_least; });
    }
    /// The part of a core that the window takes over so long. Processor time, which a machine that is busy
    /// with other things does not lengthen much.
    double share_of_core(std::chrono::seconds time) const {
        const auto used_s = [this] {
            std::ifstream stat("/proc/" + std::to_string(window_->pid()) + "/stat");
            const std::string text((std::istreambuf_iterator<char>(stat)), std::istreambuf_iterator<char>());
            std::istringstream words(text.substr(text.rfind(')') + 2));  // from the third field on
            std::string skipped;
            for (int field = 3; field < 14; ++field) words >> skipped;
            double user = 0.0, system = 0.0;
            words >> user >> system;
            return (user + system) / static_cast<double>(sysconf(_SC_CLK_TCK));
        };
        const double before_s = used_s();
        std::this_thread::sleep_for(time);
        return (used_s() - before_s) / static_cast<double>(time.count());
    }
    /// Lines come when the server's output is read.
    bool server_told_of(const std::string& text) {
        (void)server_->line_after("no such line", 1s);
        return server_->err().find(text) != std::string::npos;
    }
    void press(const std::string& key) const { ASSERT_TRUE(display_->xdotool({"key", key})) << key; }
    /// The page's cards show bones, too.
    bool shows_session() const {
        const Picture screen = display_->screen();
        return !shows_start_page(screen) && shows_bone(screen);
    }
    /// Ends the session that the window started, sees its report and closes the window.
    void finish_with_report(const std::string& begins_with) {
        press_and_see("F10");
        press("Return");
        EXPECT_TRUE(comes_true([&] {
            for (const auto& report : std::filesystem::directory_iterator(folder("home/osteomill/reports")))
                if (report.path().filename().string().starts_with(begins_with) &&
                    std::filesystem::exists(report.path() / "report.html"))
                    return true;
            return false;
        })) << window_->err();
        end_at_page();
    }
    /// The page of cases asks first.
    void end_at_page() {
        press_and_see("Escape");
        press("Return");
        EXPECT_EQ(window_->wait(), 0) << window_->err();
    }

    TemporaryFolder folder_;
    std::optional<ChildProcess> server_;
    std::string address_;
    std::optional<VirtualDisplay> display_;
    std::optional<ChildProcess> window_;
};

TEST_F(WindowTest, AnswersMouseAndKeysAndShowsWhatAnOffscreenRunDraws) {
    start_server();
    open_window({"--no-panels", "--screenshots", folder("pictures"), "--screenshot-every", "1000000"});
    const Finished offscreen = run_program(
        client({"--offscreen", "--frames", "3", "--no-panels", "--screenshots", folder("offscreen")}));
    ASSERT_EQ(offscreen.status, 0) << offscreen.err;
    const Picture first = read_png(folder("offscreen") + "/final.png");
    EXPECT_TRUE(shows(first)) << "the window differs from the offscreen picture in "
                              << difference(display_->screen(), first);

    press("F1");
    EXPECT_TRUE(shows_otherwise_than(first, 0.2)) << "help";
    press("F1");
    EXPECT_TRUE(shows(first)) << "help goes again";

    press("F2");
    EXPECT_TRUE(comes_true([&] { return display_->screen().at(2, 2)[0] > 170; })) << "light";
    press("F2");
    EXPECT_TRUE(shows(first)) << "dark again";

    press("F3");
    EXPECT_TRUE(shows_otherwise_than(first, 0.05)) << "panels";
    press("F3");
    EXPECT_TRUE(shows(first)) << "no panels";

    press("x");
    EXPECT_TRUE(shows_otherwise_than(first, 0.05)) << "a cut";
    const Picture cut = display_->screen();
    press("x");
    EXPECT_TRUE(shows_otherwise_than(cut, 0.05)) << "the other half";
    press("x");
    EXPECT_TRUE(shows(first)) << "no cut";

    // A slow machine may see a press and a release in one frame, so the button stays down until it works.
    ASSERT_TRUE(display_->xdotool({"mousemove", "240", "180", "mousedown", "3"}));
    EXPECT_TRUE(comes_true([&] {
        display_->xdotool({"mousemove_relative", "7", "2"});
        return difference(display_->screen(), first) >= 0.1;
    })) << "the view turns";
    ASSERT_TRUE(display_->xdotool({"mouseup", "3"}));
    press("Home");
    EXPECT_TRUE(shows(first)) << "the first view";

    EXPECT_TRUE(comes_true([&] {
        display_->xdotool({"keydown", "ctrl", "click", "4", "keyup", "ctrl"});
        return difference(display_->screen(), first) >= 0.1;
    })) << "ctrl + wheel zooms";
    press("Home");
    EXPECT_TRUE(shows(first));

    press("p");
    const std::filesystem::path file = folder("pictures") + "/screenshot_0001.png";
    EXPECT_TRUE(comes_true([&] { return std::filesystem::exists(file); }));
    EXPECT_TRUE(comes_true([&] {  // it may be there and not yet be written
        try {
            return difference(read_png(file), first) < 0.01;
        } catch (const std::runtime_error&) {
            return false;
        }
    }));
    EXPECT_TRUE(shows(first)) << "the notice goes";

    for (const auto& [width, height] : {std::pair("1", "1"), {"300", "1"}, {"1", "200"}, {"200", "150"}})
        ASSERT_TRUE(
            display_->xdotool({"search", "--sync", "--name", "^Osteomill$", "windowsize", width, height}))
            << width;
    ASSERT_TRUE(display_->xdotool({"search", "--sync", "--name", "^Osteomill$", "windowunmap", "--sync",
                                   "windowmap", "--sync", "windowsize", "480", "360", "windowfocus"}));
    EXPECT_TRUE(shows(first)) << "after every size, hidden and shown again";

    // The hand: down towards the tooth and into it with the pedal down.
    ASSERT_TRUE(display_->xdotool({"keydown", "w"}));
    EXPECT_TRUE(shows_otherwise_than(first, 0.01)) << "the burr moves";
    ASSERT_TRUE(display_->xdotool({"keyup", "w"}));

    press("Escape");
    EXPECT_TRUE(comes_true([&] { return difference(display_->screen(), first) >= 0.02; })) << "it asks first";
    press("Return");
    EXPECT_EQ(window_->wait(), 0) << window_->err();
}

TEST_F(WindowTest, UndoesMarksAndFinishesASessionByKeys) {
    start_server({"--record", folder("session.pcap")});
    open_window({});
    const Picture before = display_->screen();

    // A busy machine holds messages back, and then the pedal has to be pressed anew. The log has a line every
    // five seconds.
    EXPECT_TRUE(eventually([&] {
        display_->xdotool({"keydown", "space", "keydown", "w"});
        const bool has_cut = eventually(
            [&] {
                server_->read_output();
                return logged_removal_mm3(server_->err()) > 0.0;
            },
            12s);
        display_->xdotool({"keyup", "w", "keyup", "space"});
        return has_cut;
    }));
    std::this_thread::sleep_for(500ms);
    press("u");
    EXPECT_TRUE(comes_true([&] { return server_told_of("paused: force and spindle off"); }));
    ASSERT_TRUE(stands_still());
    // A slice of 3 s is given back at a time, and a machine with much to do cut for longer.
    for (int slice = 0; slice < 5; ++slice) {
        press("u");
        ASSERT_TRUE(stands_still());
    }
    press_and_see("m");
    ASSERT_TRUE(display_->xdotool({"type", "by the pulp, u r"}));
    press_and_see("Return");
    press_and_see("F10");
    press("Return");
    EXPECT_EQ(server_->wait(), 0) << server_->err();

    Playhead playhead(folder("session.pcap"));
    std::vector<ControlEvent> events;
    std::uint64_t last = 0;
    while (playhead.step(std::numeric_limits<double>::infinity()) == Playhead::Step::state) {
        events.insert(events.end(), playhead.state().events.begin(), playhead.state().events.end());
        last = playhead.bone_checksum();
    }
    ASSERT_GE(events.size(), 3U);
    EXPECT_EQ(events[0].action, SessionAction::undo);
    EXPECT_FALSE(events[0].is_refused) << events[0].text;
    // The tool is lifted out of the bone that came back, if it was in it.
    std::erase_if(events, [](const ControlEvent& event) {
        return event.action == SessionAction::place || event.action == SessionAction::undo;
    });
    ASSERT_EQ(events.size(), 2U);
    EXPECT_EQ(events[0].text, "by the pulp, u r") << "letters of a note are no commands";
    EXPECT_EQ(events[1].action, SessionAction::finish);
    EXPECT_EQ(last, Playhead(folder("session.pcap")).bone_checksum()) << "the bone is whole again";
    end_at_page();
}

TEST_F(WindowTest, IsRecordedFromWhereTheTraineeLooksAndSeenFromThereAgain) {
    start_server({"--record", folder("session.pcap")});
    open_window({"--no-panels"});
    const Picture first = display_->screen();
    ASSERT_TRUE(display_->xdotool({"mousemove", "240", "180", "mousedown", "3"}));
    EXPECT_TRUE(comes_true([&] {
        display_->xdotool({"mousemove_relative", "7", "2"});
        return difference(display_->screen(), first) >= 0.2;
    })) << "the view turns";
    ASSERT_TRUE(display_->xdotool({"mouseup", "3"}));
    press("plus");  // and is magnified
    ASSERT_TRUE(stands_still());
    const Picture seen = display_->screen();

    const auto viewpoints = [&](const std::string& name) {
        std::vector<Viewpoint> all;
        Playhead playhead(folder(name));
        while (playhead.step(std::numeric_limits<double>::infinity()) != Playhead::Step::end)
            if (playhead.state().view) all.push_back(*playhead.state().view);
        return all;
    };
    // So long as the mouse rests nothing more comes.
    ASSERT_TRUE(comes_true([&] {
        const auto all = viewpoints("session.part.pcap");
        return !all.empty() && all.back().field_of_view_rad < 0.5;
    }));
    server_->send_signal(SIGINT);
    ASSERT_TRUE(server_->wait());
    window_.reset();
    const std::vector<Viewpoint> views = viewpoints("session.pcap");
    EXPECT_GT(glm::distance(views.front().eye_mm, views.back().eye_mm), 5.0);

    std::ofstream(folder("eyes.toml"))
        << "[[cameras]]\nname = \"eyes\"\nwidth_px = 480\nheight_px = 360\nview = \"trainee\"\n";
    const Finished set =
        run_program({RENDER_CLIENT, "--replay", folder("session.pcap"), "--dataset", folder("set"),
                     "--cameras", folder("eyes.toml"), "--dataset-images", "colour"});
    ASSERT_EQ(set.status, 0) << set.err;
    const auto index = nlohmann::json::parse(std::ifstream(folder("set/dataset.json")));
    const auto& last = index["frames"].back()["images"][0];
    EXPECT_NEAR(last["pose"][0].get<double>(), views.back().eye_mm.x, 1e-9);
    EXPECT_NEAR(last["intrinsics"][0][0].get<double>(),
                180.0 / std::tan(0.5 * views.back().field_of_view_rad), 1e-6);
    EXPECT_TRUE(index["cameras"][0]["intrinsics"].is_null());
    EXPECT_LT(difference(read_png(folder("set/" + last["colour"].get<std::string>())), seen), 0.05);

    const Finished film = run_program({RENDER_CLIENT, "--replay", folder("session.pcap"), "--film",
                                       folder("film.mkv"), "--window-size", "480x360", "--no-panels"});
    ASSERT_EQ(film.status, 0) << film.err;
    const Finished picture = run_program({"/usr/bin/ffmpeg", "-loglevel", "error", "-sseof", "-1", "-i",
                                          folder("film.mkv"), "-update", "1", folder("last.png")});
    ASSERT_EQ(picture.status, 0) << picture.err;
    EXPECT_LT(difference(read_png(folder("last.png")), seen), 0.1);

    // In a window, and the person may turn the view while the recording stands.
    window_.emplace(
        display_->shown_here({RENDER_CLIENT, "--replay", folder("session.pcap"), "--camera", "trainee",
                              "--speed", "100", "--window-size", "480x360", "--no-panels"}));
    ASSERT_TRUE(
        display_->xdotool({"search", "--sync", "--onlyvisible", "--name", "^Osteomill$", "windowfocus"}));
    EXPECT_TRUE(comes_true([&] { return difference(display_->screen(), seen) < 0.1; }));
    ASSERT_TRUE(display_->xdotool({"mousedown", "3", "mousemove_relative", "60", "20"}));
    EXPECT_TRUE(comes_true([&] { return difference(display_->screen(), seen) > 0.2; }));
    ASSERT_TRUE(display_->xdotool({"mouseup", "3"}));
}

TEST_F(WindowTest, ImportsAScanAndStartsASessionOfItByMouse) {
    find_a_free_port();
    display_.emplace(glm::ivec2(1280, 800));
    std::filesystem::create_directories(folder("home/osteomill"));
    std::ofstream(folder("home/osteomill/window.toml")) << "tour_seen = true\n";
    write_block(folder("home/scan.nrrd"));
    std::ofstream(folder("home/torn.nrrd")) << "NRRD0004\n";
    window_.emplace(
        display_->shown_here({"/usr/bin/env", "HOME=" + folder("home"), "USER=anna", RENDER_CLIENT,
                              "--connect", address_, "--window-size", "1280x800"}));
    ASSERT_TRUE(
        display_->xdotool({"search", "--sync", "--onlyvisible", "--name", "^Osteomill$", "windowfocus"}));
    const auto click = [&](int x, int y) {
        ASSERT_TRUE(stands_still());
        ASSERT_TRUE(display_->xdotool({"mousemove", std::to_string(x), std::to_string(y), "sleep", "0.3",
                                       "mousedown", "1", "sleep", "0.2", "mouseup", "1"}));
    };
    const auto is_there = [&](const std::string& file) {
        return comes_true([&] { return std::filesystem::exists(folder("home/osteomill/" + file)); });
    };
    // The page is in the middle, 1204 x 616 pixels; its buttons are along its lower edge.
    const auto first_file = [&] { click(300, 194); };  // below the folder above and this home's own
    const auto second_file = [&] { click(300, 212); };
    click(99, 661);  // Import a scan
    second_file();   // a torn one: nothing but a line
    // The import fills the window except for a margin of 12 pixels; Back is there once the scan was
    // previewed.
    const auto shows_import = [&] { return *display_->screen().at(20, 400) < 45; };
    ASSERT_TRUE(comes_true(shows_import));
    ASSERT_TRUE(comes_true([&] {
        click(94, 72);
        return !shows_import();
    }));
    first_file();
    // A button that the page has not got yet is pressed again, much later.
    const auto press_until = [&](int x, int y, const std::function<bool()>& happened) {
        return eventually([&] {
            click(x, y);
            return eventually(happened, 30s);
        });
    };
    ASSERT_TRUE(press_until(40, 735, [&] {  // Import
        return std::filesystem::exists(folder("home/osteomill/cases/scan/case.toml"));
    })) << window_->err();
    ASSERT_TRUE(is_there("cases/scan/bone.nrrd"));
    ASSERT_TRUE(press_until(66, 637, [&] { return shows_session(); })) << window_->err();  // Start
    ASSERT_TRUE(is_there("reports"));
    finish_with_report("scan-");
}

TEST_F(WindowTest, StartsASessionByKeyboardAlone) {
    find_a_free_port();
    display_.emplace(glm::ivec2(1280, 800));
    window_.emplace(
        display_->shown_here({"/usr/bin/env", "HOME=" + folder("home"), "USER=anna", RENDER_CLIENT,
                              "--connect", address_, "--window-size", "1280x800"}));
    ASSERT_TRUE(
        display_->xdotool({"search", "--sync", "--onlyvisible", "--name", "^Osteomill$", "windowfocus"}));
    ASSERT_TRUE(comes_true([&] { return shows_start_page(display_->screen()); }));
    // The tour, which is seen once, has three cards.
    for (int card = 0; card < 3; ++card) press_and_see("Return");
    const auto is_kept = [&] {
        std::ifstream file(folder("home/osteomill/window.toml"));
        const std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
        return text.find("tour_seen = true") != std::string::npos;
    };
    ASSERT_TRUE(comes_true(is_kept));
    // Down from the jaw is the cube, which is chosen, then started.
    for (const char* key : {"Down", "Return", "Return"}) {
        ASSERT_TRUE(stands_still());
        const Picture before = display_->screen();
        press(key);
        ASSERT_TRUE(shows_otherwise_than(before, 0.0005)) << key << ": the focus is shown";
    }
    ASSERT_TRUE(comes_true([&] { return shows_session(); })) << window_->err();
    finish_with_report("cube-anna-");
}

TEST_F(WindowTest, DrawsOnlyWhatChanges) {
    start_server();
    // On this machine's processors a picture takes milliseconds: sixty a second would be most of one.
    open_window({});
    EXPECT_TRUE(comes_true([&] { return share_of_core(2s) < 0.05; })) << "in a session that stands still";
    const Picture before = display_->screen();

    press("F1");
    EXPECT_TRUE(shows_otherwise_than(before, 0.2)) << "help";
    press("F1");
    EXPECT_TRUE(shows(before, 0.02)) << "help goes again";
    ASSERT_TRUE(display_->xdotool({"mousemove", "240", "180", "mousedown", "3"}));
    EXPECT_TRUE(comes_true([&] {
        display_->xdotool({"mousemove_relative", "7", "2"});
        return difference(display_->screen(), before) >= 0.1;
    })) << "the view turns";
    ASSERT_TRUE(display_->xdotool({"mouseup", "3"}));
    std::this_thread::sleep_for(1s);
    ASSERT_TRUE(display_->xdotool({"search", "--sync", "--name", "^Osteomill$", "windowunmap", "--sync",
                                   "windowmap", "--sync", "windowfocus"}));
    EXPECT_TRUE(comes_true([&] { return shows_bone(display_->screen()); }));
    EXPECT_TRUE(shows_otherwise_than(before, 0.05)) << "the view that was turned";

    server_->send_signal(SIGINT);
    ASSERT_EQ(server_->wait(), 0);
    EXPECT_TRUE(comes_true([&] { return share_of_core(2s) < 0.02; })) << "after the session has ended";
    ASSERT_TRUE(stands_still()) << "the page of cases";
    press_and_see("F1");
    press_and_see("Escape");  // the help goes, the window stays
    end_at_page();
}

TEST_F(WindowTest, SaysInOneLineThatThereIsNoSoundAndTriesAgain) {
    start_server();
    ::setenv("ALSOFT_DRIVERS", "solaris", 1);  // a driver that this system does not have
    open_window({});
    ::unsetenv("ALSOFT_DRIVERS");
    EXPECT_EQ(window_->err(), "");
    const auto has_said = [&](int lines) {
        return comes_true([&] {
            (void)window_->line_after("no such line", 1s);
            return lines_of(window_->err()) == lines;
        });
    };
    press("F9");
    EXPECT_TRUE(has_said(1)) << window_->err();
    EXPECT_THAT(window_->err(), HasSubstr("no sound: OpenAL finds no output"));
    press("F9");
    EXPECT_TRUE(has_said(2)) << window_->err();
    server_->send_signal(SIGINT);
    ASSERT_EQ(server_->wait(), 0);
    ASSERT_TRUE(stands_still()) << "the page of cases";
    end_at_page();
}

TEST_F(WindowTest, EndsWithOneLineWhenTheDisplayGoes) {
    start_server();
    open_window({});
    display_->break_down();
    EXPECT_EQ(window_->wait(), 1);
    EXPECT_THAT(window_->err(), HasSubstr("display has gone"));
    EXPECT_EQ(lines_of(window_->err()), 1) << window_->err();
}

TEST_F(WindowTest, SaysWhatItFoundInPlaceOfOpenGl33AndWhatToInstall) {
    address_ = "127.0.0.1:1";  // nobody is asked
    for (const std::vector<std::string>& how : {std::vector<std::string>{}, {"--offscreen"}}) {
        std::vector<std::string> command = client(how);
        command.insert(command.begin(), {"/usr/bin/env", "MESA_GL_VERSION_OVERRIDE=2.1"});
        const Finished run = run_program(display_->shown_here(command));
        EXPECT_EQ(run.status, 1);
        EXPECT_THAT(run.err,
                    AllOf(HasSubstr("OpenGL 3.3"), HasSubstr("OpenGL 2.1"), HasSubstr("apt-get install")));
        EXPECT_EQ(lines_of(run.err), 1) << run.err;
    }
    std::vector<std::string> nowhere = client({});
    nowhere.insert(nowhere.begin(), {"/usr/bin/env", "-u", "WAYLAND_DISPLAY", "DISPLAY=:4321"});
    const Finished run = run_program(nowhere);
    EXPECT_EQ(run.status, 1);
    EXPECT_THAT(run.err, AllOf(HasSubstr(":4321"), HasSubstr("--offscreen")));
    EXPECT_EQ(lines_of(run.err), 1) << run.err;
}

}  // namespace
}  // namespace osteomill::testing
