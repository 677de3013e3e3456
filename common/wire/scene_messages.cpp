#include "common/wire/scene_messages.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <stdexcept>

#include "common/bone/patient_space.h"
#include "common/text/foreign_text.h"
#include "common/wire/geometry_messages.h"
#include "common/wire/plan_messages.h"

namespace osteomill {

namespace {

bool is_positive(double value) {
    return std::isfinite(value) && value > 0.0;
}

WireError unknown_burr(std::uint32_t burr, std::size_t burr_count) {
    return {"burr " + std::to_string(burr) + " is not one of the scene's " + std::to_string(burr_count)};
}

static_assert(static_cast<int>(ToolDriver::unknown) == v2::TOOL_DRIVER_UNKNOWN &&
                  static_cast<int>(ToolDriver::others_only) == v2::TOOL_DRIVER_OTHERS_ONLY,
              "the drivers have the numbers of the message");

/// A newer server may send values that this program does not know.
ToolDriver driver_from(v2::ToolDriver driver) {
    return v2::ToolDriver_IsValid(driver) ? static_cast<ToolDriver>(driver) : ToolDriver::unknown;
}

/// The head of a burr whose diameter is already checked; nothing if the message makes no head. A shape that
/// only a newer server knows is drawn as a ball.
std::optional<BurrHead> head_from(const v2::BurrDescription& message) {
    if (!message.has_head()) return BurrHead{};
    const v2::BurrHead& head = message.head();
    const auto* const name = std::find(head_shape_names.begin(), head_shape_names.end(), head.shape());
    if (name == head_shape_names.end()) return BurrHead{};
    const BurrHead read{static_cast<HeadShape>(name - head_shape_names.begin()), head.length_mm(),
                        head.tip_diameter_mm(), head.neck_diameter_mm()};
    try {
        require_valid(read, message.diameter_mm());
    } catch (const std::invalid_argument&) {
        return std::nullopt;
    }
    return read;
}

std::uint32_t rgb_number(const std::array<std::uint8_t, 3>& rgb) {
    return static_cast<std::uint32_t>(rgb[0]) << 16U | static_cast<std::uint32_t>(rgb[1]) << 8U | rgb[2];
}

std::array<std::uint8_t, 3> rgb_bytes(std::uint32_t rgb) {
    return {static_cast<std::uint8_t>(rgb >> 16U), static_cast<std::uint8_t>(rgb >> 8U & 0xFFU),
            static_cast<std::uint8_t>(rgb & 0xFFU)};
}

v2::CutState to_message(const CutState& cut) {
    v2::CutState message;
    message.set_force_n(static_cast<float>(cut.force_n));
    message.set_tooth_ripple_n(static_cast<float>(cut.tooth_ripple_n));
    message.set_relative_stiffness(static_cast<float>(cut.relative_stiffness));
    if (cut.loaded_rpm) message.set_loaded_rpm(static_cast<float>(*cut.loaded_rpm));
    return message;
}

CutState cut_from(const v2::CutState& message) {
    CutState cut{.force_n = static_cast<double>(message.force_n()),
                 .tooth_ripple_n = static_cast<double>(message.tooth_ripple_n()),
                 .relative_stiffness = static_cast<double>(message.relative_stiffness())};
    if (message.has_loaded_rpm()) cut.loaded_rpm = static_cast<double>(message.loaded_rpm());
    return cut;
}

bool is_finite(const CutState& cut) {
    return std::isfinite(cut.force_n) && std::isfinite(cut.tooth_ripple_n) &&
           std::isfinite(cut.relative_stiffness) && std::isfinite(cut.loaded_rpm.value_or(0.0));
}

}  // namespace

v2::BurrDescription to_message(const Burr& burr) {
    v2::BurrDescription message;
    message.set_name(burr.name);
    message.set_diameter_mm(burr.diameter_mm);
    message.set_edges(static_cast<std::uint32_t>(burr.edges));
    message.set_spindle_rpm(burr.spindle_rev_per_s * 60.0);
    message.set_clockwise(burr.sense == SpindleSense::clockwise);
    if (!burr.is_ball()) {
        v2::BurrHead& head = *message.mutable_head();
        head.set_shape(std::string(head_shape_names[static_cast<std::size_t>(burr.head.shape)]));
        head.set_length_mm(burr.head.length_mm);
        head.set_tip_diameter_mm(burr.head.tip_diameter_mm);
        head.set_neck_diameter_mm(burr.head.neck_diameter_mm);
    }
    return message;
}

v2::TissueDescription to_message(const Tissue& tissue) {
    v2::TissueDescription message;
    message.set_label(tissue.label);
    message.set_name(tissue.name);
    message.set_colour_rgb(rgb_number(tissue.colour_rgb));
    if (tissue.identifier_rgb) message.set_identifier_rgb(rgb_number(*tissue.identifier_rgb));
    message.set_is_protected(tissue.is_protected);
    message.set_opacity(tissue.opacity);
    message.set_warn_mm(tissue.warn_mm);
    message.set_shows_through_mm(tissue.shows_through_mm);
    message.set_shows_through_strength(tissue.shows_through_strength);
    return message;
}

v2::ToolState to_message(const ToolState& tool) {
    v2::ToolState message;
    message.set_time_s(tool.time_s);
    write(tool.burr_position_mm, *message.mutable_burr_position_mm());
    write(tool.spindle_axis, *message.mutable_spindle_axis());
    write(tool.hand_position_mm, *message.mutable_hand_position_mm());
    message.set_burr(static_cast<std::uint32_t>(tool.burr));
    message.set_spindle_on(tool.spindle_on);
    write(tool.force_n, *message.mutable_force_n());
    message.set_removed_mm3(tool.removed_mm3);
    message.set_touches_protected(tool.touches_protected);
    message.set_fault(std::string(tool.fault.text()));
    message.set_notice(std::string(tool.notice.text()));
    message.set_taken_unix_ns(tool.taken_unix_ns);
    message.set_driver(static_cast<v2::ToolDriver>(tool.driver));
    if (tool.depth_mm) message.set_depth_mm(*tool.depth_mm);
    if (tool.solve) {
        v2::SolveCounts& solve = *message.mutable_solve();
        solve.set_max_residual_n(tool.solve->max_residual_n);
        solve.set_fallbacks(tool.solve->fallbacks);
        solve.set_relaxed(tool.solve->relaxed);
        solve.set_damped(tool.solve->damped);
    }
    if (tool.shank_torque_n_mm) write(*tool.shank_torque_n_mm, *message.mutable_shank_torque_n_mm());
    if (tool.peak_force_n) message.set_peak_force_n(*tool.peak_force_n);
    if (tool.spindle_rpm) message.set_spindle_rpm(*tool.spindle_rpm);
    if (tool.cut) *message.mutable_cut() = to_message(*tool.cut);
    message.set_fixtures_on(tool.fixtures_on);
    message.set_fixtures_acting(tool.fixtures_acting);
    return message;
}

v2::Hello to_message(const SessionInfo& session) {
    v2::Hello hello;
    hello.set_protocol_major(session.protocol_major);
    hello.set_protocol_minor(session.protocol_minor);
    hello.set_program_version(session.server_version);
    hello.set_scene_name(session.scene_name);
    for (const Burr& burr : session.burrs) *hello.add_burrs() = to_message(burr);
    for (const Tissue& tissue : session.tissues) *hello.add_tissues() = to_message(tissue);
    hello.set_accepts_operator(session.accepts_operator);
    hello.set_force_limit_n(session.force_limit_n);
    if (session.reach_mm != longest_reach_mm) hello.set_reach_mm(session.reach_mm);
    hello.set_has_ct(session.has_ct);
    hello.set_records_view(session.records_view);
    hello.set_accepts_controls(session.accepts_controls);
    hello.set_holds_ticks(session.holds_ticks);
    if (session.plan) *hello.mutable_plan() = to_message(*session.plan);
    hello.set_trainee(session.trainee);
    hello.set_case_(session.case_name);
    for (const auto& [name, value] : session.settings) (*hello.mutable_settings())[name] = value;
    hello.set_scene_toml(session.scene_toml);
    for (const auto& [metric, mark] : session.pass) (*hello.mutable_pass())[metric] = mark;
    for (const RatingItem& item : session.rating) *hello.add_rating() = to_message(item);
    for (const Fixture& fixture : session.fixtures) *hello.add_fixtures() = to_message(fixture);
    return hello;
}

v2::OperatorInput to_message(const OperatorCommand& command) {
    v2::OperatorInput message;
    write(command.hand_target_mm, *message.mutable_hand_target_mm());
    write(command.spindle_axis, *message.mutable_spindle_axis());
    message.set_pedal(command.pedal);
    message.set_burr(static_cast<std::uint32_t>(command.burr));
    return message;
}

std::variant<std::vector<Burr>, WireError> burrs_from(
    const google::protobuf::RepeatedPtrField<v2::BurrDescription>& messages) {
    if (messages.empty()) return WireError{"the scene has no burr"};
    std::vector<Burr> burrs;
    for (const v2::BurrDescription& message : messages) {
        if (!is_positive(message.diameter_mm()) || !is_positive(message.spindle_rpm()) ||
            message.edges() > 1000)
            return WireError{"burr \"" + one_line(message.name()) +
                             "\" has an impossible size, speed or edge count"};
        const std::optional<BurrHead> head = head_from(message);
        if (!head)
            return WireError{"burr \"" + one_line(message.name()) + "\" has a head of an impossible shape"};
        burrs.push_back(
            {.name = printable(message.name()),
             .diameter_mm = message.diameter_mm(),
             .head = *head,
             .edges = static_cast<int>(message.edges()),
             .spindle_rev_per_s = message.spindle_rpm() / 60.0,
             .cutting_coefficients_n_per_mm2 = glm::dvec3(0.0),
             .sense = message.clockwise() ? SpindleSense::clockwise : SpindleSense::counter_clockwise});
    }
    return burrs;
}

std::variant<std::vector<Tissue>, WireError> tissues_from(
    const google::protobuf::RepeatedPtrField<v2::TissueDescription>& messages) {
    std::vector<Tissue> tissues;
    for (const v2::TissueDescription& message : messages) {
        const std::uint32_t rgb = message.colour_rgb();
        if (message.label() < 1 || message.label() > 255 || rgb > 0xFFFFFF ||
            message.identifier_rgb() > 0xFFFFFF)
            return WireError{"tissue \"" + one_line(message.name()) + "\" has an impossible label or colour"};
        const double opacity = message.has_opacity() ? message.opacity() : 1.0;
        const double warn_mm = message.has_warn_mm() ? message.warn_mm() : message.is_protected() ? 1.0 : 0.0;
        if (!(opacity >= 0.0 && opacity <= 1.0) || !(warn_mm >= 0.0) || !std::isfinite(warn_mm))
            return WireError{"tissue \"" + one_line(message.name()) +
                             "\" has an impossible opacity or distance to warn at"};
        const double shows_through_mm = message.has_shows_through_mm()
                                            ? message.shows_through_mm()
                                            : usual_shows_through_mm(message.is_protected());
        const double strength = message.has_shows_through_strength() ? message.shows_through_strength()
                                                                     : Tissue().shows_through_strength;
        if (!(shows_through_mm >= 0.0 && shows_through_mm <= most_shows_through_mm) ||
            !(strength >= 0.0 && strength <= 1.0))
            return WireError{"tissue \"" + one_line(message.name()) +
                             "\" shows through bone of an impossible thickness or strength"};
        tissues.push_back({.label = static_cast<std::uint8_t>(message.label()),
                           .name = printable(message.name()),
                           .colour_rgb = rgb_bytes(rgb),
                           .is_protected = message.is_protected(),
                           .opacity = opacity,
                           .warn_mm = warn_mm,
                           .shows_through_mm = shows_through_mm,
                           .shows_through_strength = strength,
                           .identifier_rgb = {}});
        if (message.has_identifier_rgb()) tissues.back().identifier_rgb = rgb_bytes(message.identifier_rgb());
    }
    return tissues;
}

std::map<std::string, std::string> settings_from(const v2::Hello& hello) {
    std::map<std::string, std::string> settings;
    for (const auto& [name, value] : hello.settings()) settings.emplace(printable(name), printable(value));
    return settings;
}

/// Marks that a later version may set for other metrics are left out.
PassMarks pass_from(const v2::Hello& hello) {
    PassMarks marks;
    for (const auto& [metric, mark] : hello.pass())
        if (const PassMarkKind* kind = pass_mark_kind(metric);
            kind != nullptr && mark >= kind->low && mark <= kind->high)
            marks.emplace(metric, mark);
    return marks;
}

std::variant<SessionInfo, WireError> session_info_from(const v2::Hello& hello) {
    auto burrs = burrs_from(hello.burrs());
    if (auto* error = std::get_if<WireError>(&burrs)) return *error;
    auto tissues = tissues_from(hello.tissues());
    if (auto* error = std::get_if<WireError>(&tissues)) return *error;
    if (!std::isfinite(hello.force_limit_n()) || hello.force_limit_n() < 0.0)
        return WireError{"the force limit is not a finite number of newtons"};
    if (!std::isfinite(hello.reach_mm()) || hello.reach_mm() < 0.0)
        return WireError{"the reach of an operator's hand is not a finite number of mm"};
    std::optional<Plan> plan;
    if (hello.has_plan()) {
        auto read = plan_from(hello.plan());
        if (auto* error = std::get_if<WireError>(&read)) return *error;
        plan = std::get<0>(std::move(read));
    }
    auto rating = rating_from(hello.rating());
    if (auto* error = std::get_if<WireError>(&rating)) return *error;
    auto fixtures = fixtures_from(hello.fixtures());
    if (auto* error = std::get_if<WireError>(&fixtures)) return *error;
    return SessionInfo{.protocol_major = hello.protocol_major(),
                       .protocol_minor = hello.protocol_minor(),
                       .scene_name = printable(hello.scene_name()),
                       .server_version = printable(hello.program_version()),
                       .burrs = std::get<0>(std::move(burrs)),
                       .tissues = std::get<0>(std::move(tissues)),
                       .accepts_operator = hello.accepts_operator(),
                       .force_limit_n = hello.force_limit_n(),
                       .reach_mm = hello.reach_mm() > 0.0 ? hello.reach_mm() : longest_reach_mm,
                       .has_ct = hello.has_ct(),
                       .accepts_controls = hello.accepts_controls(),
                       .records_view = hello.records_view(),
                       .holds_ticks = hello.holds_ticks(),
                       .plan = std::move(plan),
                       .pass = pass_from(hello),
                       .rating = std::get<0>(std::move(rating)),
                       .fixtures = std::get<0>(std::move(fixtures)),
                       .trainee = printable(hello.trainee()),
                       .case_name = printable(hello.case_()),
                       .settings = settings_from(hello),
                       .scene_toml = hello.scene_toml()};
}

std::variant<ToolState, WireError> tool_from(const v2::ToolState& message, std::size_t burr_count) {
    ToolState tool{.time_s = message.time_s(),
                   .burr_position_mm = read(message.burr_position_mm()),
                   .spindle_axis = read(message.spindle_axis()),
                   .hand_position_mm = read(message.hand_position_mm()),
                   .force_n = read(message.force_n()),
                   .burr = message.burr(),
                   .spindle_on = message.spindle_on(),
                   .removed_mm3 = message.removed_mm3(),
                   .touches_protected = message.touches_protected(),
                   .fault = one_line(message.fault()),
                   .notice = one_line(message.notice()),
                   .taken_unix_ns = message.taken_unix_ns(),
                   .driver = driver_from(message.driver()),
                   .fixtures_on = message.fixtures_on() & every_fixture,
                   .fixtures_acting = message.fixtures_acting() & every_fixture};
    if (message.has_depth_mm()) tool.depth_mm = message.depth_mm();
    if (message.has_solve())
        tool.solve = {.max_residual_n = message.solve().max_residual_n(),
                      .fallbacks = message.solve().fallbacks(),
                      .relaxed = message.solve().relaxed(),
                      .damped = message.solve().damped()};
    if (message.has_peak_force_n()) tool.peak_force_n = message.peak_force_n();
    if (message.has_spindle_rpm()) tool.spindle_rpm = message.spindle_rpm();
    if (message.has_cut()) tool.cut = cut_from(message.cut());
    if (message.has_shank_torque_n_mm()) tool.shank_torque_n_mm = read(message.shank_torque_n_mm());
    if (!std::isfinite(tool.time_s) || !std::isfinite(tool.removed_mm3) ||
        !std::isfinite(tool.depth_mm.value_or(0.0)) || !std::isfinite(tool.peak_force_n.value_or(0.0)) ||
        !std::isfinite(tool.spindle_rpm.value_or(0.0)) || !is_finite(tool.cut.value_or(CutState{})) ||
        !std::isfinite(tool.solve.value_or(SolveCounts{}).max_residual_n) ||
        !is_finite(tool.shank_torque_n_mm.value_or(glm::dvec3(0.0))) || !is_finite(tool.burr_position_mm) ||
        !is_finite(tool.spindle_axis) || !is_finite(tool.hand_position_mm) || !is_finite(tool.force_n))
        return WireError{"the tool state holds a number that is not finite"};
    if (tool.burr >= burr_count) return unknown_burr(message.burr(), burr_count);
    return tool;
}

std::variant<OperatorCommand, WireError> operator_command_from(const v2::OperatorInput& message,
                                                               std::size_t burr_count) {
    OperatorCommand command{.hand_target_mm = read(message.hand_target_mm()),
                            .spindle_axis = read(message.spindle_axis()),
                            .pedal = message.pedal(),
                            .burr = message.burr()};
    if (!is_finite(command.hand_target_mm) || !is_finite(command.spindle_axis))
        return WireError{"the operator input holds a number that is not finite"};
    const auto axis = unit_direction(command.spindle_axis);
    if (!axis) return WireError{"the operator input's spindle axis has no length, or is huge"};
    if (command.burr >= burr_count) return unknown_burr(message.burr(), burr_count);
    command.spindle_axis = *axis;
    return command;
}

}  // namespace osteomill
