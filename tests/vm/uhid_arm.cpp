// A haptic arm that the kernel takes for a real one: a HID device through /dev/uhid, with the firmware of
// virtual_arm.h, held by the simulated hand. Runs in the virtual machine beside haptic_server.
//
//     uhid_arm PROFILE.toml SCENE.toml TRAJECTORY.csv EVENTS LOG.csv
//
// The hand waits at the calibration position until the server has calibrated the arm, then follows the
// trajectory, whose start is the scene's start pose. EVENTS is a list like garbage@5.0-5.1,unplug@6.5-7.2 in
// trajectory time: garbage sends short reports and nonsense; unplug pulls the cable, and when the arm is
// plugged in again its counters have forgotten and it is calibrated where the hand then is. LOG.csv: a line a
// millisecond with the arm's true motion. Ends on SIGTERM.
#include <fcntl.h>
#include <fmt/format.h>
#include <linux/uhid.h>
#include <poll.h>
#include <sched.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <fstream>
#include <stdexcept>
#include <vector>

#include "common/scene/device_mapping.h"
#include "common/scene/scene_file.h"
#include "devices/hid/arm_profile.h"
#include "devices/hid/hid_arm.h"
#include "devices/simulated/simulated_device.h"
#include "tests/support/virtual_arm.h"

namespace {

using namespace osteomill;

constexpr double report_period_s = 0.001;  // full-speed USB
/// A person finds the arm, moves it to its calibration position, and presses the switch.
constexpr double time_to_calibrate_s = 0.3;
/// And takes the finger off it again, while the arm still is there.
constexpr double time_to_let_go_s = 0.05;

/// 14 bytes each way, not numbered, as the arm's own descriptor has it.
constexpr std::array<std::uint8_t, 28> report_descriptor{0x06, 0xAB, 0xFF,        // usage page FFAB
                                                         0x0A, 0x00, 0x02,        // usage 0200
                                                         0xA1, 0x01,              // collection (application)
                                                         0x75, 0x08,              //   8 bits
                                                         0x15, 0x00,              //   from 0
                                                         0x26, 0xFF, 0x00,        //   to 255
                                                         0x95, 0x0E, 0x09, 0x01,  //   14 of them
                                                         0x81, 0x02,              //   input
                                                         0x95, 0x0E, 0x09, 0x01,  //   14 of them
                                                         0x91, 0x02,              //   output
                                                         0xC0};

double now_s() {
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// The cable: plugged in or not.
class UhidCable {
  public:
    void plug() {
        descriptor_ = open("/dev/uhid", O_RDWR | O_CLOEXEC | O_NONBLOCK);
        if (descriptor_ < 0) throw std::runtime_error("/dev/uhid: cannot open it");
        uhid_event event{};
        event.type = UHID_CREATE2;
        std::snprintf(reinterpret_cast<char*>(event.u.create2.name), sizeof event.u.create2.name,
                      "Virtual arm");
        event.u.create2.bus = 0x03;  // USB
        event.u.create2.vendor = 0x1234;
        event.u.create2.product = 0x0006;
        event.u.create2.rd_size = report_descriptor.size();
        std::memcpy(event.u.create2.rd_data, report_descriptor.data(), report_descriptor.size());
        put(event);
    }
    void unplug() {
        close(descriptor_);
        descriptor_ = -1;
    }
    bool is_plugged() const { return descriptor_ >= 0; }

    void send(std::span<const std::uint8_t> report) {
        uhid_event event{};
        event.type = UHID_INPUT2;
        event.u.input2.size = static_cast<std::uint16_t>(report.size());
        std::memcpy(event.u.input2.data, report.data(), report.size());
        put(event);
    }

    /// Waits until `until_s`, or for something to happen; calls `take` with each report from the host.
    template <typename Take>
    void listen(double until_s, Take&& take) {
        const double left_s = until_s - now_s();
        pollfd waiting{descriptor_, POLLIN, 0};
        timespec time{0, left_s > 0.0 ? static_cast<long>(1e9 * left_s) : 0};
        ppoll(&waiting, 1, &time, nullptr);
        uhid_event event{};
        while (read(descriptor_, &event, sizeof event) > 0) {
            if (event.type != UHID_OUTPUT || event.u.output.size < 1) continue;
            take(std::span<const std::uint8_t>(event.u.output.data, event.u.output.size).subspan(1));
        }
    }

  private:
    void put(const uhid_event& event) {
        if (write(descriptor_, &event, sizeof event) < 0)
            throw std::runtime_error("/dev/uhid: it took no event");
    }
    int descriptor_ = -1;
};

struct Disturbance {
    double from_s = 1e9;
    double to_s = 1e9;
    bool holds(double time_s) const { return time_s >= from_s && time_s < to_s; }
};

/// The disturbance called `name` in a list like garbage@5.0-5.1,unplug@6.5-7.2; none: never.
Disturbance find(const std::string& events, const std::string& name) {
    Disturbance found;
    const std::size_t at = events.find(name + "@");
    if (at == std::string::npos) return found;
    if (std::sscanf(events.c_str() + at + name.size() + 1, "%lf-%lf", &found.from_s, &found.to_s) != 2)
        throw std::runtime_error("EVENTS: " + name + "@FROM-TO expected");
    return found;
}

class Session {
  public:
    Session(const std::string& profile_file, const std::string& scene_file,
            const std::string& trajectory_file, const std::string& events, const std::string& log_file)
        : profile_(load_arm_profile(profile_file)),
          scene_(placed(read_scene(scene_file), profile_, trajectory_file)),
          hand_(make_trajectory(scene_.trajectory, scene_.start_pose, scene_.burrs, scene_.start_burr),
                scene_.device, ArmModel{.resolution_mm = 0.0}, hand_model(Grip::firm)),
          arm_(profile_),
          garbage_(find(events, "garbage")),
          unplug_(find(events, "unplug")),
          log_(log_file) {
        log_ << "time_s,x_mm,y_mm,z_mm,force_x_n,force_y_n,force_z_n,plugged\n";
    }

    void run(const std::atomic<bool>& stop) {
        cable_.plug();
        wait_for_calibration([] {});
        fmt::print("calibrated\n");
        began_s_ = now_s();
        bool is_under_way = true;
        for (double next_s = began_s_; !stop; next_s = std::max(next_s + report_period_s, now_s())) {
            step(next_s);
            if (is_under_way && hand_.is_finished()) fmt::print("followed the trajectory to its end\n");
            is_under_way = !hand_.is_finished();
        }
    }

  private:
    static Scene placed(Scene scene, const ArmProfile& profile, const std::string& trajectory_file) {
        scene.device.offset_mm = scene.start_pose.position_mm - home_position_mm(profile);
        scene.trajectory.source = std::filesystem::path(trajectory_file);
        return scene;
    }

    /// Answers the host until it has set the counters.
    template <typename Meanwhile>
    void wait_for_calibration(Meanwhile&& meanwhile) {
        const std::uint64_t before = arm_.calibrations();
        arm_.power_up();
        double asks_s = 1e9;
        double lets_go_s = 1e9;
        while (now_s() < lets_go_s) {
            meanwhile();
            listen_until(now_s() + report_period_s);
            if (!is_answer_due_) continue;
            if (asks_s > 1e8) asks_s = now_s() + time_to_calibrate_s;
            const bool is_calibrated = arm_.calibrations() != before;
            if (is_calibrated) lets_go_s = std::min(lets_go_s, now_s() + time_to_let_go_s);
            if (now_s() > asks_s && !is_calibrated) arm_.ask_for_calibration();
            cable_.send(arm_.report());
            is_answer_due_ = false;
        }
    }

    /// Reads each request before it answers: a report a millisecond, as USB has it.
    void listen_until(double until_s) {
        do {
            cable_.listen(until_s, [this](auto report) {
                arm_.take(report, now_s());
                is_answer_due_ = true;
            });
        } while (now_s() < until_s);
    }

    void move_arm() {
        const double time_s = now_s() - began_s_;
        hand_.write(cable_.is_plugged() ? arm_.force_n(now_s()) : glm::dvec3(0.0));
        const DeviceState state = hand_.read(time_s);
        arm_.move_to(state.position_mm);
        arm_.press_switch(state.pedal.is_down);
        const glm::dvec3 force_n = cable_.is_plugged() ? arm_.force_n(now_s()) : glm::dvec3(0.0);
        const glm::dvec3 p = position_in_patient_mm(scene_.device, state.position_mm);
        log_ << fmt::format("{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{}\n", time_s, p.x, p.y, p.z,
                            force_n.x, force_n.y, force_n.z, cable_.is_plugged() ? 1 : 0);
    }

    void step(double until_s) {
        const double time_s = now_s() - began_s_;
        if (cable_.is_plugged() && unplug_.holds(time_s)) {
            cable_.unplug();
            fmt::print("unplugged at {:.3f}\n", time_s);
        }
        if (!cable_.is_plugged() && !unplug_.holds(time_s)) {
            cable_.plug();
            fmt::print("plugged in at {:.3f}\n", time_s);
            wait_for_calibration([this] { move_arm_to_home(); });
            fmt::print("calibrated at {:.3f}\n", now_s() - began_s_);
            return;
        }
        move_arm();
        if (!cable_.is_plugged()) {
            const timespec nap{0, static_cast<long>(1e9 * report_period_s)};
            nanosleep(&nap, nullptr);
            return;
        }
        listen_until(until_s);
        if (garbage_.holds(now_s() - began_s_)) {
            send_garbage();
        } else if (is_answer_due_) {
            cable_.send(arm_.report());
        }
        is_answer_due_ = false;
    }

    /// A hand that calibrates holds the arm against its stop, whatever it did before.
    void move_arm_to_home() {
        move_arm();
        arm_.move_to(home_position_mm(profile_));
    }

    void send_garbage() {
        std::array<std::uint8_t, 14> report{};
        report.fill(static_cast<std::uint8_t>(0x31 + 7 * garbage_count_));
        const std::size_t size = garbage_count_++ % 2 == 0 ? 5 : report.size();
        cable_.send(std::span(report).first(size));
    }

    ArmProfile profile_;
    Scene scene_;
    SimulatedDevice hand_;
    testing::VirtualArm arm_;
    UhidCable cable_;
    Disturbance garbage_;
    Disturbance unplug_;
    int garbage_count_ = 0;
    std::ofstream log_;
    double began_s_ = 0.0;
    bool is_answer_due_ = false;
};

std::atomic<bool> stop_requested{false};  // a signal handler may use nothing else

}  // namespace

int main(int argc, char** argv) {
    if (argc != 6) {
        fmt::print(stderr, "usage: uhid_arm PROFILE.toml SCENE.toml TRAJECTORY.csv EVENTS LOG.csv\n");
        return 2;
    }
    try {
        // The arm is hardware: no program of the machine delays it.
        sched_param highest{};
        highest.sched_priority = 80;
        sched_setscheduler(0, SCHED_FIFO, &highest);
        std::signal(SIGTERM, [](int) { stop_requested.store(true); });
        std::setvbuf(stdout, nullptr, _IOLBF, 0);
        Session(argv[1], argv[2], argv[3], argv[4], argv[5]).run(stop_requested);
    } catch (const std::exception& error) {
        fmt::print(stderr, "uhid_arm: {}\n", error.what());
        return 1;
    }
}
