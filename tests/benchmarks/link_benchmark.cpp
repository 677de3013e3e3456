// The link's costs beside their targets: sizes, rates and the delay of a motion. Prints, and says which
// target was missed; asserts nothing.
//
// Snapshot: the tooth phantom's, 512 x 512 x 128 voxels, as a new client receives it. Its raw size: that of
// its voxels, a byte for each of fraction, stiffness and tissue.
// Carving, idle: the session on the virtual clock, its state frames as a client that keeps up receives them.
// Carving: the 5 mm burr clears a cavity in the cube at 6 mm/s, which no force slows down; as sent to a
// client in packed changes, and as recorded. Idle: a hand holds the tool still.
// Motion: a device on the real clock that moves by 0.2 mm now and then; from the device's reading of that
// to a client's having the frame that shows it, over loopback.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <limits>
#include <memory>
#include <random>
#include <thread>
#include <vector>

#include "common/wire/scene_messages.h"
#include "devices/simulated/simulated_device.h"
#include "haptic_server/streaming/live_session.h"
#include "haptic_server/streaming/outgoing_frames.h"
#include "haptic_server/streaming/streaming_server.h"
#include "imaging/case/bone_source.h"
#include "imaging/phantoms/phantom.h"
#include "render_client/link/bone_link.h"
#include "simulation/loop/milling_session.h"

namespace osteomill {
namespace {

using Clock = std::chrono::steady_clock;

/// Prints each measure beside its target, and keeps those that missed it.
class Targets {
  public:
    void print(const std::string& what, double value, const std::string& unit, double target) {
        const bool is_missed = value >= target;
        fmt::print("{:<44}{:>10.2f} {:<5} target under {:g}{}\n", what, value, unit, target,
                   is_missed ? ": MISSED" : "");
        std::fflush(stdout);
        ++count_;
        if (is_missed) missed_.push_back(what.substr(what.find_first_not_of(' ')));
    }
    void print_sum() const {
        if (missed_.empty())
            fmt::print("all {} targets are met\n", count_);
        else
            fmt::print("{} of {} targets are MISSED: {}\n", missed_.size(), count_, fmt::join(missed_, "; "));
    }

  private:
    int count_ = 0;
    std::vector<std::string> missed_;
};

double ms_between(Clock::time_point from, Clock::time_point to) {
    return std::chrono::duration<double, std::milli>(to - from).count();
}

void measure_snapshot(Targets& targets, const Scene& scene, const Bone& bone) {
    const BoneReplica mirror(bone);
    FramePackers packers;
    const auto began = Clock::now();
    OutgoingFrames outgoing(to_message(session_info(scene, false, 3.3, "")), mirror, packers);
    std::size_t bytes = 0;
    while (const auto frame = outgoing.next()) bytes += frame->size();
    const double pack_ms = ms_between(began, Clock::now());
    const glm::dvec3 size(bone.grid().size_voxels);
    const double raw_bytes = 3.0 * size.x * size.y * size.z;
    const double sent = static_cast<double>(bytes);
    targets.print("snapshot, share of 512 x 512 x 128 voxels", 100.0 * sent / raw_bytes, "%", 15);
    fmt::print("  {:.2f} MB of {:.1f} MB; of the {:.1f} MB that are stored {:.1f} %; packed in {:.0f} ms\n",
               1e-6 * sent, 1e-6 * raw_bytes, 3e-6 * static_cast<double>(bone.stored_bricks()) * 4096,
               100.0 * sent / (3.0 * static_cast<double>(bone.stored_bricks()) * 4096), pack_ms);
    constexpr double bytes_per_s_of_100_mbit = 12.5e6;
    // Packing and sending take turns, piece by piece, at worst.
    targets.print("snapshot, time at 100 Mbit/s", sent / bytes_per_s_of_100_mbit + 1e-3 * pack_ms, "s", 1);
}

struct Rate {
    double mean_bytes_per_s = 0.0;
    double most_bytes_in_a_second = 0.0;
    double removed_mm3 = 0.0;
    double most_removed_mm3_in_a_second = 0.0;
};

Trajectory trajectory_of(const Scene& scene) {
    return make_trajectory(scene.trajectory, scene.start_pose, scene.burrs, scene.start_burr);
}

/// A device that follows its trajectory whatever pushes back.
class DeviceOnRails final : public HapticDevice {
  public:
    explicit DeviceOnRails(Trajectory trajectory) : trajectory_(std::move(trajectory)) {}
    std::string name() const override { return "rails"; }
    DeviceLimits limits() const override { return {}; }
    void start() override {}
    DeviceState read(double now_s) noexcept override {
        const TrajectorySample now = trajectory_.at(now_s);
        return {.position_mm = now.target.position_mm,
                .spindle_axis = now.target.spindle_axis,
                .pedal = {.is_down = now_s > 0.0 && now.pedal, .said_s = now_s}};
    }
    void write(const glm::dvec3&) noexcept override {}
    void stop() noexcept override {}

  private:
    Trajectory trajectory_;
};

/// Bytes of state frames from `from_s` to the session's end.
Rate rate_of(const Scene& scene, const Bone& bone, HapticDevice& device, double from_s, double to_s) {
    const auto session = std::make_unique<MillingSession>(
        scene, bone, device,
        MillingSessionOptions{
            .clock = ClockKind::virtual_time, .duration_s = to_s, .changes_are_consumed = true});
    LiveSession shown(session->exchange().tool, session->exchange().changes);
    BoneReplica mirror(bone);
    FramePackers packers;
    OutgoingFrames outgoing(to_message(session_info(scene, false, 3.3, "")), mirror, packers);
    while (outgoing.next()) {
    }
    std::vector<double> bytes_in_second(static_cast<std::size_t>(to_s - from_s) + 1, 0.0);
    std::vector<double> removed_in_second_mm3(bytes_in_second.size(), 0.0);
    double removed_before_mm3 = 0.0;
    double removed_mm3 = 0.0;
    std::uint64_t frames = 0;
    session->run(std::atomic<bool>{false}, [&](const ToolState&) {
        SessionState state = shown.update(mirror, 1);
        const ToolState& tool = state.tool;
        state.tool.taken_unix_ns = 1'700'000'000'000'000'000;  // as a server would
        outgoing.note(mirror.take_changes());
        outgoing.request_state(state, frames++ % 30 == 0);
        std::size_t bytes = 0;
        while (const auto frame = outgoing.next()) bytes += frame->size();
        const double removed_now_mm3 = tool.removed_mm3 - std::exchange(removed_mm3, tool.removed_mm3);
        if (tool.time_s < from_s) {
            removed_before_mm3 = removed_mm3;
            return;
        }
        const auto second = static_cast<std::size_t>(tool.time_s - from_s);
        bytes_in_second[second] += static_cast<double>(bytes);
        removed_in_second_mm3[second] += removed_now_mm3;
    });
    Rate rate{.removed_mm3 = removed_mm3 - removed_before_mm3,
              .most_removed_mm3_in_a_second = std::ranges::max(removed_in_second_mm3)};
    for (const double bytes : bytes_in_second) {
        rate.mean_bytes_per_s += bytes / (to_s - from_s);
        rate.most_bytes_in_a_second = std::max(rate.most_bytes_in_a_second, bytes);
    }
    return rate;
}

void measure_carving(Targets& targets) {
    Scene scene = phantom_scene("cube");  // with a burr of 5 mm
    const Bone bone = load_bone(scene).bone;
    scene.trajectory.source = BuiltInTrajectory::cavity;
    scene.trajectory.speed_mm_per_s = 6.0;
    scene.trajectory.width_mm = 9.0;
    scene.trajectory.depth_mm = 4.0;
    constexpr double from_s = 2.0;
    constexpr double to_s = 32.0;
    scene.device = {};
    DeviceOnRails device(trajectory_of(scene));
    const Rate rate = rate_of(scene, bone, device, from_s, to_s);
    targets.print("carving at 6 mm/s with the 5 mm burr", 1e-3 * rate.mean_bytes_per_s, "kB/s", 60);
    targets.print("  the worst second of it", 1e-3 * rate.most_bytes_in_a_second, "kB/s", 300);
    fmt::print("  {:.1f} mm^3 removed in {:.0f} s, {:.1f} mm^3 in the second that cuts most\n",
               rate.removed_mm3, to_s - from_s, rate.most_removed_mm3_in_a_second);
}

void measure_idle(Targets& targets, Scene scene, const Bone& bone) {
    scene.trajectory.source = BuiltInTrajectory::hold;
    SimulatedDevice device(trajectory_of(scene), scene.device, ArmModel{}, hand_model(Grip::firm));
    const Rate rate = rate_of(scene, bone, device, 2.0, 12.0);
    targets.print("idle", 1e-3 * rate.mean_bytes_per_s, "kB/s", 3);
}

/// A device that is held still but for steps along x, and remembers when it read the last.
class SteppingDevice final : public HapticDevice {
  public:
    explicit SteppingDevice(const glm::dvec3& position_mm) : position_mm_(position_mm) {}
    std::string name() const override { return "steps"; }
    DeviceLimits limits() const override { return {}; }
    void start() override {}
    DeviceState read(double) noexcept override {
        const int wanted = wanted_.load();
        if (wanted != read_) {
            read_ = wanted;
            read_at_.store(Clock::now().time_since_epoch().count());
        }
        return {.position_mm = position_mm_ + glm::dvec3(0.2 * (read_ % 2), 0.0, 0.0)};
    }
    void write(const glm::dvec3&) noexcept override {}
    void stop() noexcept override {}

    /// Any thread.
    void step() { ++wanted_; }
    Clock::time_point read_at() const { return Clock::time_point(Clock::duration(read_at_.load())); }

  private:
    const glm::dvec3 position_mm_;
    std::atomic<int> wanted_{0};
    std::atomic<Clock::rep> read_at_{0};
    int read_ = 0;
};

void measure_motion(Targets& targets, Scene scene, const Bone& bone) {
    scene.device = {};
    SteppingDevice device(scene.start_pose.position_mm);
    const auto session = std::make_unique<MillingSession>(
        scene, bone, device, MillingSessionOptions{.changes_are_consumed = true});
    LiveSession shown(session->exchange().tool, session->exchange().changes);
    StreamingServer server({.port = 0}, session_info(scene, false, 3.3, ""), bone, shown);
    server.start();
    std::atomic<bool> is_over{false};
    std::thread running([&] { session->run(is_over); });

    BoneLink link("127.0.0.1", server.port());
    std::optional<double> seen_x_mm;
    std::optional<DelayMeter::Delay> stamped;
    const auto newest = [&] {
        const LinkUpdate update = link.poll();
        stamped = update.delay;
        if (update.tool) seen_x_mm = update.tool->hand_position_mm.x;
        std::this_thread::sleep_for(std::chrono::microseconds(200));
        return seen_x_mm;
    };
    while (!newest()) {
    }
    std::vector<double> delays_ms;
    std::vector<double> stamped_ms;
    std::mt19937 random(1);
    std::uniform_real_distribution<double> rest_s(0.05, 0.1);
    for (int i = 0; i < 200; ++i) {
        const auto until = Clock::now() + std::chrono::duration<double>(rest_s(random));
        while (Clock::now() < until) newest();
        const double before_mm = *seen_x_mm;
        device.step();
        while (std::abs(*newest() - before_mm) < 0.1) {
        }
        delays_ms.push_back(ms_between(device.read_at(), Clock::now()));
        stamped_ms.push_back(1e3 * stamped->by_clocks_s);
    }
    is_over = true;
    running.join();
    server.stop();
    std::ranges::sort(delays_ms);
    std::ranges::sort(stamped_ms);
    targets.print("motion to frame at 30 Hz, median", delays_ms[delays_ms.size() / 2], "ms", 40);
    targets.print("motion to frame at 30 Hz, 99th percentile", delays_ms[delays_ms.size() * 99 / 100], "ms",
                  40);
    fmt::print(
        "  of that after the server took it, as the client shows: median {:.2f} ms, 99th percentile "
        "{:.2f} ms\n",
        stamped_ms[stamped_ms.size() / 2], stamped_ms[stamped_ms.size() * 99 / 100]);
}

}  // namespace
}  // namespace osteomill

int main() {
    using namespace osteomill;
    const Scene scene = phantom_scene("tooth");
    const Bone bone = load_bone(scene).bone;
    fmt::print("takes about half a minute\n");
    std::fflush(stdout);
    Targets targets;
    measure_snapshot(targets, scene, bone);
    measure_carving(targets);
    measure_idle(targets, scene, bone);
    measure_motion(targets, scene, bone);
    targets.print_sum();
    return 0;
}
