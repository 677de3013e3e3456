// How long a window's drawing thread is away from its input while the head of 2048^3 voxels comes from a real
// server over loopback, is prepared and first drawn; while another look is prepared; and while an undo
// changes thousands of bricks. Beside them the same bone's textures made in one go. Prints; asserts nothing.
//
//     large_bone_benchmark [WIDTH HEIGHT]
//
// The loop is the window's, without one. 400 x 300 pixels unless said otherwise: what arrives is measured,
// not how fast a software rasteriser draws. An answer is a turn of the loop: input is taken at its begin, and
// what comes of it is drawn at its end.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <ranges>
#include <string>
#include <thread>
#include <vector>

#include "common/program/available_memory.h"
#include "render_client/ui/view/redraw.h"
#include "render_client/ui/view/session_picture.h"
#include "tests/support/child_process.h"

namespace osteomill {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr std::size_t needed_bytes = std::size_t{4} << 30U;
constexpr std::size_t bricks_of_undo = 8000;
constexpr std::chrono::milliseconds shortest_frame(16);  // as in a window
constexpr std::chrono::seconds longest_wait(300);

double ms_since(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// The server's session, and what an undo of much would bring.
class HeadSession final : public SessionSource {
  public:
    explicit HeadSession(std::uint16_t port) : linked_("127.0.0.1", port, std::nullopt, std::nullopt) {}

    void undo_much() { undoes_ = true; }
    LinkUpdate poll() override {
        LinkUpdate update = linked_.poll();
        if (!std::exchange(undoes_, false)) return update;
        const auto& bricks = bone()->content().brick_of_slot;
        VoxelMask all;
        for (std::size_t voxel = 0; voxel < brick_voxel_count; ++voxel) all.set(voxel);
        for (std::size_t slot = 0; slot < std::min(bricks_of_undo, bricks.size()); ++slot)
            update.changes.push_back({bricks[slot], all, ChangeKind::restored});
        return update;
    }
    const Bone* bone() const override { return linked_.bone(); }
    const SessionInfo* session() const override { return linked_.session(); }
    void send_operator(const OperatorCommand&) override {}

  private:
    LinkedSession linked_;
    bool undoes_ = false;
};

struct Turn {
    double at_s = 0.0;
    double take_in_ms = 0.0;
    double draw_ms = 0.0;
    std::optional<int> percent{};
    double all_ms() const { return take_in_ms + draw_ms; }
};

/// The window's loop, without a window.
class Loop {
  public:
    explicit Loop(SessionPicture& picture) : picture_(picture) { redraw_.note_change(began_); }

    /// Until this holds after a turn, and everything due is drawn at full quality.
    template <typename Done>
    void run(const std::string& what, Done done) {
        const Clock::time_point start = Clock::now();
        turns_.clear();
        while (!done() || picture_.preparation_percent()) {
            turn(start);
            if (Clock::now() - start > longest_wait) throw std::runtime_error(what + " does not end");
        }
        const double done_s = 1e-3 * ms_since(start);
        std::ranges::sort(turns_, std::greater(), &Turn::all_ms);
        fmt::print("{}: {:.1f} s, {} turns; longest {:.0f} ms", what, done_s, turns_.size(),
                   turns_.front().all_ms());
        for (const Turn& each : turns_ | std::views::take(5))
            fmt::print(" [at {:.2f} s: taking in {:.0f}, drawing {:.0f} ms{}]", each.at_s, each.take_in_ms,
                       each.draw_ms, each.percent ? fmt::format(", prepared {} %", *each.percent) : "");
        fmt::print("\n");
    }

  private:
    void turn(Clock::time_point start) {
        const Clock::time_point now = Clock::now();
        Turn turn{.at_s = 1e-3 * ms_since(start)};
        const SessionNews news = picture_.take_in();
        turn.take_in_ms = ms_since(now);
        turn.percent = picture_.preparation_percent();
        if (news == SessionNews::change) redraw_.note_change(now);
        if (news == SessionNews::figures) redraw_.note_figures();
        if (redraw_.is_due(now)) {
            const Clock::time_point begins = Clock::now();
            picture_.draw(std::chrono::duration<double>(begins - drawn_).count()).depth_at({0, 0});
            drawn_ = begins;
            turn.draw_ms = ms_since(begins);
            redraw_.drew(now, Clock::now() - now);
            picture_.frame_took(1e-3 * ms_since(now));
        }
        turns_.push_back(turn);
        std::this_thread::sleep_until(now + shortest_frame);
    }

    SessionPicture& picture_;
    Redraw redraw_;
    const Clock::time_point began_ = Clock::now();
    Clock::time_point drawn_ = began_;
    std::vector<Turn> turns_;
};

void measure(const glm::ivec2& size_px) {
    testing::ChildProcess server(
        {HAPTIC_SERVER, "--scene", "head", "--device", "client", "--listen", "127.0.0.1:0"});
    const auto address = server.line_after("listening on ", 120s);
    if (!address) throw std::runtime_error("the server did not start: " + server.err());
    const gl::OffscreenContext context;
    fmt::print("{}, {} x {}\n", gl::renderer_name(), size_px.x, size_px.y);
    auto second = context.second();
    if (!second) throw std::runtime_error("the driver makes no second context");
    gl::StorageThread storage(std::move(second));

    HeadSession session(static_cast<std::uint16_t>(std::stoi(address->substr(address->rfind(':') + 1))));
    Panels panels;
    SessionPicture picture(session, panels, size_px, FrameQuality::on_demand);
    picture.make_storage_by(storage);
    Loop loop(picture);
    loop.run("received", [&] { return session.bone() != nullptr; });
    loop.run("refined", [&] { return picture.quality().refined; });
    picture.set_shading({.transfer = transfer_presets()[1]});
    loop.run("another look", [&] { return picture.quality().refined; });
    session.undo_much();
    int turns = 0;
    loop.run(fmt::format("{} bricks changed", bricks_of_undo), [&] { return ++turns > 100; });

    const Clock::time_point start = Clock::now();
    const BoneTextures at_once(*session.bone(), {});
    glFinish();
    fmt::print("in one go: {:.0f} ms without an answer; {}\n", ms_since(start), description(at_once.plan()));
}

}  // namespace
}  // namespace osteomill

int main(int argument_count, char** arguments) {
    const auto available_bytes = osteomill::available_memory_bytes().value_or(0);
    if (available_bytes < osteomill::needed_bytes) {
        fmt::print("skipped: the head, twice, takes {} MiB of memory; {} are free\n",
                   osteomill::needed_bytes >> 20U, available_bytes >> 20U);
        return 0;
    }
    try {
        osteomill::measure(argument_count == 3 ? glm::ivec2(std::stoi(arguments[1]), std::stoi(arguments[2]))
                                               : glm::ivec2(400, 300));
    } catch (const std::exception& error) {
        fmt::print(stderr, "large_bone_benchmark: {}\n", error.what());
        return 1;
    }
    return 0;
}
