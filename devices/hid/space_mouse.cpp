#include "devices/hid/space_mouse.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "common/scene/device_mapping.h"

namespace osteomill {

namespace {

constexpr double full_deflection = 350.0;
/// A puck at rest is not quite centred.
constexpr double dead_share = 0.05;

double share(double deflection) noexcept {
    const double size = std::min(1.0, std::abs(deflection) / full_deflection);
    const double beyond = std::max(0.0, size - dead_share) / (1.0 - dead_share);
    return deflection < 0.0 ? -beyond : beyond;
}

/// Three int16, turned into device space.
glm::dvec3 axes(std::span<const std::uint8_t> bytes) noexcept {
    const auto field = [&](std::size_t i) {
        return static_cast<double>(
            static_cast<std::int16_t>(static_cast<std::uint16_t>(bytes[2 * i] | bytes[2 * i + 1] << 8)));
    };
    return {share(field(0)), -share(field(1)), -share(field(2))};
}

constexpr std::size_t three_axes = 6;

}  // namespace

bool SpaceMouseState::take(std::span<const std::uint8_t> report) noexcept {
    if (report.size() < 2) return false;
    const std::span<const std::uint8_t> values = report.subspan(1);
    switch (report[0]) {
        case 1:
            if (values.size() < three_axes) return false;
            translation = axes(values);
            if (values.size() >= 2 * three_axes) rotation = axes(values.subspan(three_axes));
            return true;
        case 2:
            if (values.size() < three_axes) return false;
            rotation = axes(values);
            return true;
        case 3:
            buttons = 0;
            for (std::size_t i = 0; i < std::min<std::size_t>(values.size(), 4); ++i)
                buttons |= static_cast<std::uint32_t>(values[i]) << (8 * i);
            return true;
        default:
            return false;  // battery and the like
    }
}

bool is_space_mouse(const HidDeviceInfo& device) {
    constexpr std::uint16_t logitech = 0x046D;
    constexpr std::uint16_t own_vendor = 0x256F;
    constexpr std::uint16_t generic_desktop = 0x01;
    constexpr std::uint16_t multi_axis_controller = 0x08;
    const bool is_product =
        device.vendor_id == own_vendor ||
        (device.vendor_id == logitech && device.product_id >= 0xC603 && device.product_id <= 0xC6FF);
    return is_product && device.usage_page == generic_desktop && device.usage == multi_axis_controller;
}

namespace {

constexpr std::uint32_t pedal_button = 1;
constexpr std::uint32_t next_burr_button = 2;
constexpr int longest_mouse_wait_ms = 10;
constexpr int most_mouse_reports_at_once = 64;

class MouseConversation final : public HidConversation {
  public:
    MouseConversation(std::unique_ptr<HidConnection> connection, std::function<double()> clock_s,
                      std::uint64_t number, TripleBuffer<SpaceMouseReading>& readings)
        : connection_(std::move(connection)),
          clock_s_(std::move(clock_s)),
          number_(number),
          readings_(readings),
          empty_s_(clock_s_()) {}

    bool exchange() noexcept override {
        const bool is_plugged = take_reports();
        if (clock_s_() - reported_s_ > SpaceMouse::longest_deflection_age_s) {
            state_.translation = glm::dvec3(0.0);
            state_.rotation = glm::dvec3(0.0);
        }
        readings_.back() = {
            .state = state_, .is_plugged = is_plugged, .said_s = empty_s_, .connection = number_};
        readings_.publish();
        return is_plugged;
    }

    const char* notice() const noexcept override { return ""; }

  private:
    bool take_reports() noexcept {
        std::array<std::uint8_t, 64> buffer;
        const double began_s = clock_s_();
        for (int i = 0; i < most_mouse_reports_at_once; ++i) {
            const int bytes = connection_->read(buffer, i == 0 ? longest_mouse_wait_ms : 0);
            if (bytes < 0) return false;
            if (bytes == 0) {
                empty_s_ = began_s;
                return true;
            }
            if (state_.take({buffer.data(), static_cast<std::size_t>(bytes)})) reported_s_ = clock_s_();
        }
        return true;
    }

    std::unique_ptr<HidConnection> connection_;
    std::function<double()> clock_s_;
    std::uint64_t number_;
    TripleBuffer<SpaceMouseReading>& readings_;
    SpaceMouseState state_;
    double reported_s_ = 0.0;
    double empty_s_;
};

HidWorkerParts parts_of(HidTransport& transport, std::function<double()> clock_s,
                        std::function<void()> on_thread_start, TripleBuffer<SpaceMouseReading>& readings) {
    return {
        .transport = transport,
        .is_wanted = is_space_mouse,
        .what = "3D mouse (3Dconnexion SpaceMouse)",
        .begin = [clock_s = std::move(clock_s), number = std::uint64_t{0}, &readings](
                     std::unique_ptr<HidConnection> connection) mutable -> std::unique_ptr<HidConversation> {
            return std::make_unique<MouseConversation>(std::move(connection), clock_s, ++number, readings);
        },
        .on_thread_start = std::move(on_thread_start)};
}

}  // namespace

SpaceMouse::SpaceMouse(const Scene& scene, const ArmModel& arm, const HandModel& hand,
                       HidTransport& transport, std::function<double()> clock_s,
                       std::function<void()> on_thread_start)
    : arm_(arm),
      clock_s_(clock_s),
      held_arm_(arm, hand, position_in_device_mm(scene.device, scene.start_pose.position_mm)),
      target_mm_(position_in_device_mm(scene.device, scene.start_pose.position_mm)),
      spindle_axis_(direction_in_device(scene.device, scene.start_pose.spindle_axis)),
      burr_(scene.start_burr),
      burr_count_(scene.burrs.size()),
      worker_(parts_of(transport, std::move(clock_s), std::move(on_thread_start), readings_)) {}

void SpaceMouse::move_target(const SpaceMouseState& mouse, double elapsed_s) noexcept {
    const double deflection = glm::length(mouse.translation);
    target_mm_ += fastest_mm_per_s * elapsed_s * deflection * mouse.translation;
    const glm::dvec3 lead_mm = target_mm_ - held_arm_.truth().position_mm();
    const double length_mm = glm::length(lead_mm);
    if (length_mm > longest_lead_mm)
        target_mm_ = held_arm_.truth().position_mm() + lead_mm * (longest_lead_mm / length_mm);

    const glm::dvec3 turn_rad = fastest_rad_per_s * elapsed_s * glm::length(mouse.rotation) * mouse.rotation;
    spindle_axis_ = glm::normalize(spindle_axis_ + glm::cross(turn_rad, spindle_axis_));
}

DeviceState SpaceMouse::read(double now_s) noexcept {
    const bool is_new = readings_.refresh();
    const SpaceMouseReading& mouse = readings_.front();
    if (is_new) permission_.renew(said_at(now_s, clock_s_() - mouse.said_s));
    const bool is_heard = mouse.is_plugged && permission_.holds(now_s);
    const double elapsed_s = now_s - read_at_s_;
    read_at_s_ = now_s;
    if (is_heard) move_target(mouse.state, elapsed_s);
    held_arm_.advance(now_s, target_mm_, spindle_axis_);

    if (is_heard) {
        const bool next_pressed = (mouse.state.buttons & next_burr_button) != 0;
        if (next_pressed && !was_next_pressed_) burr_ = (burr_ + 1) % burr_count_;
        was_next_pressed_ = next_pressed;
    }
    return {.position_mm = held_arm_.sensor().position_mm(),
            .velocity_mm_per_s = held_arm_.sensor().velocity_mm_per_s(),
            .spindle_axis = spindle_axis_,
            .pedal = {.is_down = (mouse.state.buttons & pedal_button) != 0,
                      .said_s = permission_.renewed_s(),
                      .speaker = mouse.connection},
            .burr = burr_,
            .connected = is_heard};
}

}  // namespace osteomill
