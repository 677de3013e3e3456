#include "common/session/tick_sample.h"

#include <array>
#include <cmath>
#include <type_traits>

#include "common/session/written_pose.h"
#include "common/text/append.h"

namespace osteomill {

namespace {

template <auto member>
double number(const TickSample& tick) {
    return static_cast<double>(tick.*member);
}

template <auto member>
void set_number(TickSample& tick, double value) {
    tick.*member = static_cast<std::remove_reference_t<decltype(tick.*member)>>(value);
}

template <auto member, glm::length_t axis>
double component(const TickSample& tick) {
    return (tick.*member)[axis];
}

template <auto member, glm::length_t axis>
void set_component(TickSample& tick, double value) {
    (tick.*member)[axis] = value;
}

template <glm::length_t axis>
double torque(const TickSample& tick) {
    return tick.shank_torque_n_mm.value_or(glm::dvec3(0.0))[axis];
}

template <glm::length_t axis>
void set_torque(TickSample& tick, double value) {
    if (!tick.shank_torque_n_mm) tick.shank_torque_n_mm.emplace(0.0);
    (*tick.shank_torque_n_mm)[axis] = value;
}

/// Rest of a number beyond so many decimals.
template <int decimals>
double beyond(double value) {
    return value - from_code(to_code(value, decimals), decimals);
}

template <glm::length_t axis>
double hand_rest(const TickSample& tick) {
    return beyond<4>(tick.hand_mm[axis]);
}

template <glm::length_t axis>
void add_hand_rest(TickSample& tick, double rest) {
    if (rest != 0.0) tick.hand_mm[axis] = with_decimals<hand_decimals_mm>(tick.hand_mm[axis] + rest);
}

template <glm::length_t axis>
double axis_rest(const TickSample& tick) {
    return beyond<6>(tick.spindle_axis[axis]);
}

template <glm::length_t axis>
void add_axis_rest(TickSample& tick, double rest) {
    if (rest != 0.0) tick.spindle_axis[axis] = with_decimals<axis_decimals>(tick.spindle_axis[axis] + rest);
}

/// Counted from 1; 0: no burr is requested.
double asked_burr(const TickSample& tick) {
    return tick.input && tick.input->burr ? static_cast<double>(*tick.input->burr + 1) : 0.0;
}

void set_asked_burr(TickSample& tick, double value) {
    if (!tick.input) tick.input.emplace();
    if (value > 0.0) tick.input->burr = static_cast<std::size_t>(value) - 1;
}

template <auto member>
double of_input(const TickSample& tick) {
    return tick.input ? static_cast<double>((*tick.input).*member) : 0.0;
}

template <auto member>
void set_in_input(TickSample& tick, double value) {
    if (!tick.input) tick.input.emplace();
    auto& part = (*tick.input).*member;
    if constexpr (std::is_same_v<decltype(part), bool&>)
        part = value > 0.0;
    else
        part = static_cast<std::remove_reference_t<decltype(part)>>(value);
}

template <auto member>
constexpr TickQuantity one(const char* name, const char* unit, int decimals, bool in_log = true) {
    return {name, unit, decimals, decimals, in_log, TickPart::always, number<member>, set_number<member>};
}

template <auto member, glm::length_t axis>
constexpr TickQuantity along(const char* name, const char* unit, int decimals, bool in_log = true) {
    return {name,
            unit,
            decimals,
            decimals,
            in_log,
            TickPart::always,
            component<member, axis>,
            set_component<member, axis>};
}

/// Recorded decimals are as in older recordings; the rest follows at the end.
template <glm::length_t axis>
constexpr TickQuantity hand_along(const char* name) {
    TickQuantity quantity = along<&TickSample::hand_mm, axis>(name, "mm", 4);
    quantity.log_decimals = hand_decimals_mm;
    return quantity;
}

template <glm::length_t axis>
constexpr TickQuantity torque_along(const char* name) {
    return {name, "N mm", 4, 4, true, TickPart::torque, torque<axis>, set_torque<axis>};
}

template <glm::length_t axis>
constexpr TickQuantity hand_rest_along(const char* name) {
    return {name,  "mm",           hand_decimals_mm, hand_decimals_mm,
            false, TickPart::rest, hand_rest<axis>,  add_hand_rest<axis>};
}

template <glm::length_t axis>
constexpr TickQuantity axis_rest_along(const char* name) {
    return {
        name, "1", axis_decimals, axis_decimals, false, TickPart::rest, axis_rest<axis>, add_axis_rest<axis>};
}

template <auto of, auto set>
constexpr TickQuantity input(const char* name) {
    return {name, "1", 0, 0, false, TickPart::input, of, set};
}

template <auto member>
constexpr TickQuantity input_number(const char* name, TickPart part = TickPart::input) {
    return {name, "1", 0, 0, false, part, of_input<member>, set_in_input<member>};
}

using T = TickSample;

// Recordings have them in this order; a reader that knows fewer ignores the last ones.
constexpr std::array quantities{one<&T::time_s>("t_s", "s", 4),
                                hand_along<0>("hand_x_mm"),
                                hand_along<1>("hand_y_mm"),
                                hand_along<2>("hand_z_mm"),
                                along<&T::burr_mm, 0>("burr_x_mm", "mm", 4),
                                along<&T::burr_mm, 1>("burr_y_mm", "mm", 4),
                                along<&T::burr_mm, 2>("burr_z_mm", "mm", 4),
                                along<&T::force_n, 0>("force_x_n", "N", 5),
                                along<&T::force_n, 1>("force_y_n", "N", 5),
                                along<&T::force_n, 2>("force_z_n", "N", 5),
                                one<&T::depth_mm>("depth_mm", "mm", 4),
                                one<&T::removed_mm3>("removed_mm3", "mm^3", 5),
                                one<&T::spindle_on>("spindle", "1", 0),
                                one<&T::fault>("fault", "1", 0),
                                along<&T::spindle_axis, 0>("axis_x", "1", 6, false),
                                along<&T::spindle_axis, 1>("axis_y", "1", 6, false),
                                along<&T::spindle_axis, 2>("axis_z", "1", 6, false),
                                one<&T::burr>("burr", "1", 0, false),
                                torque_along<0>("shank_torque_x_n_mm"),
                                torque_along<1>("shank_torque_y_n_mm"),
                                torque_along<2>("shank_torque_z_n_mm"),
                                hand_rest_along<0>("hand_x_rest_mm"),
                                hand_rest_along<1>("hand_y_rest_mm"),
                                hand_rest_along<2>("hand_z_rest_mm"),
                                axis_rest_along<0>("axis_x_rest"),
                                axis_rest_along<1>("axis_y_rest"),
                                axis_rest_along<2>("axis_z_rest"),
                                input_number<&TickInput::pedal>("pedal"),
                                input<asked_burr, set_asked_burr>("asked_burr"),
                                input_number<&TickInput::lets_go>("lets_go"),
                                input_number<&TickInput::steps>("milling_steps"),
                                input_number<&TickInput::holds_still>("holds_still", TickPart::control),
                                input_number<&TickInput::switched>("switched_fixtures", TickPart::control),
                                input_number<&TickInput::chosen_rpm>("chosen_rpm", TickPart::control),
                                input_number<&TickInput::is_placed>("is_placed", TickPart::control),
                                input_number<&TickInput::restored>("restored_bricks", TickPart::control)};

}  // namespace

std::span<const TickQuantity> tick_quantities() {
    return quantities;
}

std::string TickSample::header_line(bool has_torque) {
    std::string line;
    for (const TickQuantity& quantity : quantities)
        if (quantity.in_log && (quantity.part == TickPart::always || has_torque))
            line += fmt::format("{}{}", line.empty() ? "" : ",", quantity.name);
    return line + '\n';
}

void TickSample::append_to(fmt::memory_buffer& text) const {
    const char* separator = "";
    for (const TickQuantity& quantity : quantities) {
        if (!quantity.in_log || !quantity.is_of(*this)) continue;
        append_formatted(text, "{}{:.{}f}", separator, quantity.of(*this), quantity.log_decimals);
        separator = ",";
    }
    text.push_back('\n');
}

namespace {

constexpr std::array powers_of_ten{1.0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9};

}  // namespace

std::int64_t to_code(double value, int decimals) {
    const double magnitude = std::abs(value);
    const double scale = powers_of_ten[static_cast<std::size_t>(decimals)];
    double whole = std::floor(magnitude * scale);
    // The sign is that of the exact value, although the product was rounded.
    const double beyond_half = std::fma(magnitude, scale, -(whole + 0.5));
    if (beyond_half > 0.0 || (beyond_half == 0.0 && std::fmod(whole, 2.0) == 1.0)) whole += 1.0;
    if (!(whole < largest_decimal_code)) whole = largest_decimal_code;
    const auto code = static_cast<std::int64_t>(whole);
    return std::signbit(value) ? ~code : code;
}

double from_code(std::int64_t code, int decimals) {
    const double scale = powers_of_ten[static_cast<std::size_t>(decimals)];
    return code < 0 ? -(static_cast<double>(~code) / scale) : static_cast<double>(code) / scale;
}

}  // namespace osteomill
