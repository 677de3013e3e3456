// Nothing turns without leave, with the real programs: the effects on a real server of a client that is cut,
// frozen, late or hostile. Times are the server's own: see spindle_log.h.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <array>
#include <boost/asio/buffer.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/write.hpp>
#include <chrono>
#include <cmath>
#include <csignal>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "common/wire/frame.h"
#include "common/wire/scene_messages.h"
#include "render_client/link/bone_link.h"
#include "tests/support/child_process.h"
#include "tests/support/eventually.h"
#include "tests/support/held_pedal.h"
#include "tests/support/link_proxy.h"
#include "tests/support/spindle_log.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/virtual_display.h"

namespace osteomill::testing {
namespace {

using namespace std::chrono_literals;
using boost::asio::ip::tcp;
using ::testing::HasSubstr;
using ::testing::Not;

/// The spindle's longest run without leave.
constexpr double off_within_s = 0.25;

int count_of(const std::string& text, const std::string& what) {
    int count = 0;
    for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++count;
    return count;
}

/// Speaks the protocol, and says whatever it likes.
class HostileClient {
  public:
    explicit HostileClient(std::uint16_t port) {
        socket_.connect({boost::asio::ip::address_v4::loopback(), port});
        socket_.non_blocking(true);
        v2::ClientFrame greeting;
        greeting.mutable_hello()->set_protocol_major(protocol_major);
        send(std::move(greeting));
    }

    /// Reads the waiting frames; returns whether a state was among them.
    bool reads_state() {
        std::array<std::uint8_t, 65536> bytes;
        boost::system::error_code error;
        while (const std::size_t count = socket_.read_some(boost::asio::buffer(bytes), error)) {
            decoder_.append(std::span(bytes).first(count));
            while (const auto message = decoder_.next()) {
                v2::ServerFrame frame;
                EXPECT_TRUE(frame.ParseFromArray(message->data(), static_cast<int>(message->size())));
                if (!frame.has_state()) continue;
                newest_state_ = frame.sequence();
                tool_ = std::get<ToolState>(tool_from(frame.state().tool(), 100));
            }
        }
        return newest_state_ > 0;
    }
    const ToolState& tool() const { return tool_; }

    struct Lie {
        bool names_state = true;
        std::uint64_t number = 0;  // 0: one higher than before
    };
    void want(const OperatorCommand& command) { want(command, Lie{}); }
    void want(const OperatorCommand& command, const Lie& lie) {
        v2::ClientFrame frame;
        *frame.mutable_operator_input() = to_message(command);
        frame.mutable_operator_input()->set_number(lie.number != 0 ? lie.number : ++number_);
        if (lie.names_state) frame.mutable_operator_input()->set_answers_state(newest_state_);
        send(std::move(frame));
    }

  private:
    void send(v2::ClientFrame frame) {
        frame.set_sequence(++sequence_);
        std::string bytes;
        append_frame(frame, bytes);
        boost::system::error_code ignored;
        boost::asio::write(socket_, boost::asio::buffer(bytes), ignored);
    }

    boost::asio::io_context io_;
    tcp::socket socket_{io_};
    FrameDecoder decoder_;
    std::uint64_t sequence_ = 0, number_ = 0, newest_state_ = 0;
    ToolState tool_;
};

class Permissions : public ::testing::Test {
  protected:
    Permissions()
        : server_({HAPTIC_SERVER, "--scene", "cube", "--device", "client", "--listen", "127.0.0.1:0",
                   "--log-csv", (folder_ / "log.csv").string()}) {
        const auto address = server_.address();
        if (!address) throw std::runtime_error(server_.err());
        address_ = *address;
        port_ = static_cast<std::uint16_t>(std::stoi(address->substr(address->rfind(':') + 1)));
    }

    /// Ends the session; returns the spindle's log.
    std::vector<ForceLogLine> log_of_session() {
        server_.send_signal(SIGINT);
        EXPECT_EQ(server_.wait(), 0) << server_.err();
        return read_force_log(folder_ / "log.csv");
    }

    /// The log of the ticks so far.
    std::vector<ForceLogLine> log_so_far() const { return read_force_log(folder_ / "log.part.csv"); }

    /// The newest tool, with which the session's clock is set.
    std::optional<ToolState> seen(BoneLink& link) {
        link.poll();
        const auto tool = link.newest_tool();
        if (tool) clock_.note(*tool);
        return tool;
    }
    /// An operator at the tool's place, whose pedal is down.
    void drive(BoneLink& link, bool pedal = true) {
        const auto tool = seen(link);
        if (!tool) return;
        link.send_operator(
            {.hand_target_mm = tool->hand_position_mm, .pedal = pedal_.is_down(tool->spindle_on) && pedal});
    }
    /// Drives until so, or for so long.
    template <typename Condition>
    bool drive_until(BoneLink& link, Condition&& condition,
                     std::chrono::milliseconds at_most = far_too_long) {
        const auto end = std::chrono::steady_clock::now() + at_most;
        while (!condition()) {
            if (std::chrono::steady_clock::now() > end) return false;
            drive(link);
            std::this_thread::sleep_for(10ms);
        }
        return true;
    }
    void drive_for(BoneLink& link, std::chrono::milliseconds time) {
        drive_until(
            link, [] { return false; }, time);
    }
    bool gets_spindle(BoneLink& link, std::chrono::milliseconds at_most = far_too_long) {
        const auto turns = [&] {
            const auto tool = seen(link);
            return tool && tool->spindle_on;
        };
        return drive_until(link, turns, at_most);
    }

    TemporaryFolder folder_;
    ChildProcess server_;
    std::string address_;
    std::uint16_t port_ = 0;
    SessionClock clock_;
    HeldPedal pedal_;
};

TEST_F(Permissions, EndsWhenAClientIsCutOff) {
    BoneLink watching("127.0.0.1", port_);
    double cut_s = 0.0;
    {
        LinkProxy cable(port_);
        BoneLink link("127.0.0.1", cable.port());
        ASSERT_TRUE(gets_spindle(link));
        drive_for(link, 500ms);
        ASSERT_TRUE(gets_spindle(link)) << "it turns still, or again";
        cable.cut();  // in silence
        cut_s = clock_.now_s();
        drive_for(link, 1s);
    }
    const auto off_s = spindle_off_after_s(log_of_session(), cut_s);
    ASSERT_TRUE(off_s);
    EXPECT_LE(*off_s, off_within_s);
}

TEST_F(Permissions, IsHadAgainOnlyByThePedalPressedAnew) {
    BoneLink link("127.0.0.1", port_);
    ASSERT_TRUE(gets_spindle(link));
    // By the session's time.
    const auto say_for = [&](double time_s, bool pedal) {
        const double began_s = clock_.now_s();
        EXPECT_TRUE(eventually([&] {
            const auto tool = seen(link);
            link.send_operator({.hand_target_mm = tool->hand_position_mm, .pedal = pedal});
            std::this_thread::sleep_for(10ms);
            return tool->time_s > began_s + time_s;
        }));
        return began_s;
    };
    std::this_thread::sleep_for(1s);  // not a word
    const double held_s = say_for(1.0, true);
    const double lifted_s = say_for(0.3, false);
    EXPECT_TRUE(gets_spindle(link)) << "pressed anew";
    int heard = 0;
    for (const ForceLogLine& tick : log_of_session()) {
        if (tick.time_s < held_s || tick.time_s > lifted_s) continue;
        ++heard;
        ASSERT_FALSE(tick.spindle_on) << tick.time_s - held_s << " s after the messages came back";
    }
    EXPECT_GT(heard, 100);
}

TEST_F(Permissions, EndsBehindAnUpstreamThatTurnsLateAndIsNotHadBehindOneThatIs) {
    LinkProxy cable(port_);
    BoneLink link("127.0.0.1", cable.port());
    ASSERT_TRUE(gets_spindle(link));
    drive_for(link, 500ms);
    ASSERT_TRUE(gets_spindle(link)) << "it turns still, or again";
    cable.delay(5s, 0ms);
    const double late_s = clock_.now_s();  // the pedal comes up, too
    for (const auto end = std::chrono::steady_clock::now() + 1s; std::chrono::steady_clock::now() < end;
         std::this_thread::sleep_for(10ms))
        drive(link, false);
    // Now it is down again, and everything arrives, five seconds late.
    drive_for(link, 7s);
    const double end_s = clock_.now_s();
    const auto log = log_of_session();
    const auto off_s = spindle_off_after_s(log, late_s);
    ASSERT_TRUE(off_s);
    EXPECT_LE(*off_s, off_within_s);
    for (const ForceLogLine& sample : log) {
        const bool is_late = sample.time_s > late_s + off_within_s && sample.time_s < end_s;
        ASSERT_FALSE(is_late && sample.spindle_on) << sample.time_s - late_s << " s behind the delay";
    }
    EXPECT_THAT(server_.err(), HasSubstr("answers what was so more than 250 ms ago"));
    EXPECT_LE(count_of(server_.err(), "answers what was so"), 3);
}

TEST_F(Permissions, IsNotHadByAClientWhosePictureIsASecondOld) {
    LinkProxy cable(port_);
    cable.delay(0ms, 1s);
    BoneLink link("127.0.0.1", cable.port());
    EXPECT_FALSE(gets_spindle(link, 4s));
    for (const ForceLogLine& sample : log_of_session()) ASSERT_FALSE(sample.spindle_on) << sample.time_s;
}

TEST_F(Permissions, IsKeptOverALinkWithADelayOf100Ms) {
    LinkProxy cable(port_);
    cable.delay(50ms, 50ms);
    BoneLink link("127.0.0.1", cable.port());
    // A machine with much to do may hold back messages: some time it does not.
    double off_s = 0.0;
    EXPECT_TRUE(eventually([&] {
        EXPECT_TRUE(gets_spindle(link));
        const double on_s = clock_.now_s();
        drive_for(link, 3s);
        off_s = spindle_stood_s(log_so_far(), on_s, clock_.now_s());
        return off_s < 0.3;
    })) << off_s
        << " s of 3 s";
}

TEST_F(Permissions, OfOneMessageReachesNoFartherThanAHand) {
    HostileClient client(port_);
    ASSERT_TRUE(eventually([&] { return client.reads_state(); }));
    const ToolState before = client.tool();
    client.want({.hand_target_mm = before.hand_position_mm + glm::dvec3(100.0, 0.0, 0.0), .pedal = true});
    std::this_thread::sleep_for(2s);
    const auto log = log_of_session();
    double travelled_mm = 0.0, turned_s = 0.0;
    for (const ForceLogLine& sample : log) {
        travelled_mm = std::max(travelled_mm, std::abs(sample.burr_mm[0] - log.front().burr_mm[0]));
        if (sample.spindle_on) turned_s += 0.001;
    }
    // A hand's reach, and as far as a hand swings that is stopped.
    EXPECT_LT(travelled_mm, 10.0);
    EXPECT_LE(turned_s, off_within_s);
    EXPECT_EQ(count_of(server_.err(), "more than 6 mm from the burr"), 1) << server_.err();
}

TEST_F(Permissions, OfAHostileClientIsHeldToAHandAndNamedOnce) {
    HostileClient client(port_);
    ASSERT_TRUE(eventually([&] { return client.reads_state(); }));
    const auto began = std::chrono::steady_clock::now();
    for (int i = 0; i < 400; ++i) {  // from side to side 400 times a second, each a metre away
        client.reads_state();
        client.want({.hand_target_mm = {i % 2 == 0 ? 1000.0 : -1000.0, 0.0, 25.0}, .pedal = true});
        std::this_thread::sleep_until(began + i * 2500us);
    }
    const auto log = log_of_session();
    for (std::size_t i = 1; i < log.size(); ++i) {
        const double speed = std::abs(log[i].burr_mm[0] - log[i - 1].burr_mm[0]) /
                             std::max(log[i].time_s - log[i - 1].time_s, 0.001);
        ASSERT_LT(speed, 500.0) << "mm/s at " << log[i].time_s;
    }
    EXPECT_THAT(server_.err(), HasSubstr("faster than a hand (500 mm/s)"));
    EXPECT_LE(count_of(server_.err(), "6 mm from the burr"), 2) << "alone, then both together";
}

TEST_F(Permissions, IsNotHadByRepeatingMessagesNorByClientsThatNameNoState) {
    HostileClient old(port_);
    ASSERT_TRUE(eventually([&] { return old.reads_state(); }));
    for (int i = 0; i < 50; ++i) {
        old.reads_state();
        old.want({.hand_target_mm = old.tool().hand_position_mm, .pedal = true}, {.names_state = false});
        std::this_thread::sleep_for(10ms);
    }
    HostileClient repeating(port_);
    ASSERT_TRUE(eventually([&] { return repeating.reads_state(); }));
    // A message that was held back on a busy machine turns nothing, and is no answer to this one.
    bool has_turned = false;
    std::uint64_t number = 0;
    EXPECT_TRUE(eventually([&] {
        repeating.reads_state();
        repeating.want({.hand_target_mm = repeating.tool().hand_position_mm, .pedal = false},
                       {.number = ++number});
        std::this_thread::sleep_for(100ms);
        ++number;
        for (int i = 0; i < 100; ++i) {
            repeating.reads_state();
            has_turned = has_turned || repeating.tool().spindle_on;
            repeating.want({.hand_target_mm = repeating.tool().hand_position_mm, .pedal = true},
                           {.number = number});
            std::this_thread::sleep_for(10ms);
        }
        return has_turned;
    }));
    const auto log = log_of_session();
    const double turned_s = log.back().time_s - spindle_stood_s(log, 0.0, log.back().time_s);
    EXPECT_GT(turned_s, 0.0);
    EXPECT_LE(turned_s, off_within_s * static_cast<double>(number / 2)) << "for the first of each number";
    EXPECT_EQ(count_of(server_.err(), "looks on and moves nothing"), 1) << server_.err();
}

/// render_client in a window, with its pedal down.
class WindowPermissions : public Permissions {
  protected:
    void SetUp() override {
        if (const std::string missing = VirtualDisplay::missing(); !missing.empty())
            GTEST_SKIP() << "needs " << missing;
    }
    void press_pedal(const glm::ivec2& size_px, const std::vector<std::string>& more = {}) {
        display_.emplace(size_px);
        std::vector<std::string> command{RENDER_CLIENT,
                                         "--connect",
                                         address_,
                                         "--home",
                                         (folder_ / "home").string(),
                                         "--window-size",
                                         fmt::format("{}x{}", size_px.x, size_px.y)};
        command.insert(command.end(), more.begin(), more.end());
        window_.emplace(display_->shown_here(command));
        ASSERT_TRUE(
            display_->xdotool({"search", "--sync", "--onlyvisible", "--name", "^Osteomill$", "windowfocus"}))
            << window_->err();
        ASSERT_TRUE(gets_spindle_by_key()) << window_->err();
    }
    bool gets_spindle_by_key() {
        return eventually([&] {
            display_->xdotool({"keydown", "space"});
            if (watch_for(500ms, [](const ToolState& tool) { return tool.spindle_on; })) return true;
            display_->xdotool({"keyup", "space"});
            watch_for(100ms, never);
            return false;
        });
    }
    /// Whether that comes true while it watches; at the longest for so long.
    template <typename Condition>
    bool watch_for(std::chrono::milliseconds time, Condition&& condition) {
        const auto end = std::chrono::steady_clock::now() + time;
        while (std::chrono::steady_clock::now() < end) {
            if (const auto update = watching_.poll(); update.tool) {
                clock_.note(*update.tool);
                if (condition(*update.tool)) return true;
            }
            std::this_thread::sleep_for(5ms);
        }
        return false;
    }
    static bool never(const ToolState&) { return false; }

    BoneLink watching_{"127.0.0.1", port_};
    std::optional<VirtualDisplay> display_;
    std::optional<ChildProcess> window_;
};

TEST_F(WindowPermissions, EndWhenTheClientIsFrozen) {
    press_pedal({480, 360});
    // A signal takes its time on a machine with much to do: some come late, not all.
    int in_time = 0;
    EXPECT_TRUE(eventually([&] {
        watch_for(500ms, never);
        const double frozen_s = clock_.now_s();
        window_->send_signal(SIGSTOP);
        EXPECT_TRUE(watch_for(far_too_long, [](const ToolState& tool) { return !tool.spindle_on; }));
        window_->send_signal(SIGCONT);
        EXPECT_FALSE(watch_for(500ms, [](const ToolState& tool) { return tool.spindle_on; }))
            << "the pedal is held";
        display_->xdotool({"keyup", "space"});
        const auto off_s = spindle_off_after_s(log_so_far(), frozen_s);
        if (off_s && *off_s <= off_within_s) ++in_time;
        EXPECT_TRUE(gets_spindle_by_key()) << "it comes back";
        return in_time == 2;
    }));
}

TEST_F(WindowPermissions, AreKeptWhileTheWindowDrawsSlowlyAndEndWithThePedal) {
    // Each picture is written into a file: so large a one takes most of a second.
    press_pedal({2800, 2000}, {"--screenshots", (folder_ / "pictures").string(), "--screenshot-every", "1"});
    // A machine with much to do may hold back messages: some time it does not.
    double stood_s = 0.0, late_s = 0.0;
    EXPECT_TRUE(eventually([&] {
        EXPECT_TRUE(gets_spindle_by_key());
        watch_for(1s, never);
        const double on_s = clock_.now_s();
        watch_for(4s, never);
        const double up_s = clock_.now_s();
        EXPECT_TRUE(display_->xdotool({"keyup", "space"}));
        const double is_up_s = clock_.now_s();
        EXPECT_TRUE(watch_for(far_too_long, [](const ToolState& tool) { return !tool.spindle_on; }));
        watch_for(500ms, never);  // until that is in the log
        const auto log = log_so_far();
        stood_s = spindle_stood_s(log, on_s, up_s);
        const auto after_s = spindle_off_after_s(log, up_s);
        late_s = after_s.value_or(1e9) - (is_up_s - up_s);
        return stood_s < 0.4 && late_s <= off_within_s;
    })) << "stood for "
        << stood_s << " s of 4 s; turned for " << late_s << " s after the pedal was up";
}

}  // namespace
}  // namespace osteomill::testing
