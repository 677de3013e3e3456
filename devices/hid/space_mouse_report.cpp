#include "devices/hid/space_mouse_report.h"

#include <algorithm>
#include <cmath>

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

}  // namespace osteomill
