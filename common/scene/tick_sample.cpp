#include "common/scene/tick_sample.h"

#include <array>
#include <iterator>
#include <type_traits>

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

template <auto member>
constexpr TickQuantity one(const char* name, const char* unit, int decimals, bool in_log = true) {
    return {name, unit, decimals, in_log, number<member>, set_number<member>};
}

template <auto member, glm::length_t axis>
constexpr TickQuantity along(const char* name, const char* unit, int decimals, bool in_log = true) {
    return {name, unit, decimals, in_log, component<member, axis>, set_component<member, axis>};
}

template <glm::length_t axis>
constexpr TickQuantity torque_along(const char* name) {
    return {name, "N mm", 4, true, torque<axis>, set_torque<axis>};
}

using T = TickSample;

// Recordings have them in this order.
constexpr std::array quantities{one<&T::time_s>("t_s", "s", 4),
                                along<&T::hand_mm, 0>("hand_x_mm", "mm", 4),
                                along<&T::hand_mm, 1>("hand_y_mm", "mm", 4),
                                along<&T::hand_mm, 2>("hand_z_mm", "mm", 4),
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
                                torque_along<2>("shank_torque_z_n_mm")};

}  // namespace

std::span<const TickQuantity> tick_quantities() {
    return quantities;
}

std::span<const TickQuantity> tick_quantities(bool has_torque) {
    return std::span(quantities).first(quantities.size() - (has_torque ? 0 : torque_quantities));
}

std::string TickSample::header_line(bool has_torque) {
    std::string line;
    for (const TickQuantity& quantity : tick_quantities(has_torque))
        if (quantity.in_log) line += fmt::format("{}{}", line.empty() ? "" : ",", quantity.name);
    return line + '\n';
}

void TickSample::append_to(fmt::memory_buffer& text) const {
    const char* separator = "";
    for (const TickQuantity& quantity : tick_quantities(shank_torque_n_mm.has_value())) {
        if (!quantity.in_log) continue;
        fmt::format_to(std::back_inserter(text), "{}{:.{}f}", separator, quantity.of(*this),
                       quantity.decimals);
        separator = ",";
    }
    text.push_back('\n');
}

}  // namespace osteomill
