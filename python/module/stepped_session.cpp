#include "python/module/stepped_session.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "common/recording/recording_writer.h"
#include "common/text/foreign_text.h"
#include "haptic_server/session/device_table.h"
#include "haptic_server/session/session_defaults.h"
#include "haptic_server/session/session_settings.h"
#include "simulation/loop/spindle_torque.h"

namespace osteomill::python {

namespace {

/// Computed without a check whether the caller wants to stop.
constexpr std::uint64_t ticks_at_once = 1000;

double power_w(double torque_n_mm, const Burr& burr) {
    return 1e-3 * torque_n_mm * 2.0 * std::numbers::pi * burr.spindle_rev_per_s;
}

MillingSessionOptions milling_options(const SteppedOptions& options) {
    MillingSessionOptions milling{.clock = ClockKind::virtual_time,
                                  .force_model = options.force_model,
                                  .vibration = options.vibration,
                                  // The caller that steps it ends it, even if its trajectory has no end.
                                  .duration_s = std::numeric_limits<double>::max()};
    milling.coupling = options.coupling.value_or(
        usual_coupling(find_force_model(options.force_model).has_cutting_law, devices().front()));
    milling.milling_rate_hz =
        options.milling_rate_hz.value_or(usual_milling_rate_hz(milling.coupling, milling.force_model));
    return milling;
}

/// All inputs of the computation, a line for each: two sessions with the same lines are the same function of
/// their hand.
std::string origin_of(const std::map<std::string, std::string>& settings, const std::string& scene_toml,
                      const std::string& case_name) {
    std::string text = fmt::format("case = {}\n", case_name);
    // Every instruction set gives the same bits.
    for (const auto& [name, value] : settings)
        if (name != "instruction_set") text += fmt::format("{} = {}\n", name, value);
    return text + scene_toml;
}

/// Limits of the arm at a prescribed hand, which is read without encoder steps.
DeviceLimits limits_at_prescribed_hand(const std::optional<ArmModel>& given) {
    ArmModel arm = given.value_or(ideal_arm());
    arm.resolution_mm = 0.0;
    return limits_of(arm);
}

/// The values of an arm that its limits do not hold.
std::string line_of(const std::optional<ArmModel>& arm) {
    if (!arm) return "";
    return fmt::format("arm = {} kg, {} N of friction, {} N s/mm, {} mm, {} ms late\n", arm->mass_kg,
                       arm->coulomb_friction_n, arm->damping_n_s_per_mm, arm->resolution_mm, arm->delay_ms);
}

/// The first line in which two origins differ.
std::string first_difference(const std::string& of_state, const std::string& of_session) {
    std::istringstream theirs(of_state);
    std::istringstream ours(of_session);
    for (std::string their_line, our_line;;) {
        const bool has_theirs = static_cast<bool>(std::getline(theirs, their_line));
        const bool has_ours = static_cast<bool>(std::getline(ours, our_line));
        if (!has_theirs && !has_ours) return "";
        if (!has_theirs) their_line = "no more";
        if (!has_ours) our_line = "no more";
        if (their_line != our_line)
            return fmt::format("of the state: {}; of this session: {}", one_line(their_line),
                               one_line(our_line));
    }
}

}  // namespace

SteppedSession::SteppedSession(std::shared_ptr<const LoadedCase> loaded, SteppedOptions options)
    : loaded_(std::move(loaded)), options_(std::move(options)) {
    begin();
}

SteppedSession::SteppedSession(const SteppedSession& other)
    : loaded_(other.loaded_), options_(other.options_), origin_(other.origin_) {
    if (other.has_ended_) throw std::logic_error("the session has ended; make another");
    options_.record.reset();
    const Run& from = other.run_;
    DeviceParts parts;
    if (from.prescribed != nullptr) {
        auto prescribed = std::make_unique<PrescribedDevice>(*from.prescribed);
        run_.prescribed = prescribed.get();
        parts.device = std::move(prescribed);
    } else {
        auto simulated = std::make_unique<SimulatedDevice>(*from.simulated);
        run_.simulated = parts.simulated = simulated.get();
        parts.device = std::move(simulated);
    }
    run_.assembly = std::make_unique<SessionAssembly>(*from.assembly, std::move(parts));
    run_.tool = from.tool;
    run_.burr_before_mm = from.burr_before_mm;
    run_.hand = from.hand;
    run_.fed = from.fed;
}

SteppedSession::~SteppedSession() {
    try {
        end();
    } catch (const std::exception&) {
        // A caller that must know whether a recording is whole ends the session itself.
    }
}

void SteppedSession::begin() {
    SessionScene scene = loaded_->scene();
    if (options_.start) scene.scene.start_pose = *options_.start;
    run_.hand = scene.scene.start_pose;
    DeviceParts parts;
    if (options_.grip) {
        parts = simulated_hand(scene.scene, *options_.grip, options_.arm.value_or(ArmModel{}));
        run_.simulated = parts.simulated;
    } else {
        auto prescribed = std::make_unique<PrescribedDevice>(run_.hand, scene.scene.device,
                                                             limits_at_prescribed_hand(options_.arm));
        run_.prescribed = prescribed.get();
        parts.device = std::move(prescribed);
    }
    SessionOptions session{.milling = milling_options(options_)};
    scene = seated(std::move(scene), parts);
    const auto settings = as_texts(session_settings(session.milling, loaded_->choice(), scene,
                                                    {.device = options_.grip ? "simulated" : "prescribed",
                                                     .grip = options_.grip.value_or(Grip::firm),
                                                     .arm = parts.device->limits()},
                                                    OSTEOMILL_VERSION));
    const std::string scene_toml = effective_scene_text(scene.scene);
    origin_ = origin_of(settings, scene_toml, loaded_->name()) + line_of(options_.arm);
    if (options_.record) {
        session.shown.emplace();
        session.shown->streaming.listens = false;
        session.shown->streaming.record =
            RecordTo{.file = *options_.record, .began = std::chrono::system_clock::now()};
        session.shown->accepts_controls = false;
        session.shown->case_name = loaded_->name();
        session.shown->version = OSTEOMILL_VERSION;
        session.shown->settings = settings;
        session.shown->scene_toml = scene_toml;
    }
    // The assembly before, if any, is destroyed only once the new one exists.
    run_.assembly = std::make_unique<SessionAssembly>(std::move(scene), std::move(parts), std::move(session));
    run_.assembly->start();
    run_.assembly->advance(1);
    run_.tool = run_.assembly->session().newest_state();
    run_.burr_before_mm = run_.tool.burr_position_mm;
    run_.fed.clear();
}

void SteppedSession::make_ticks(const HandInput& input) {
    if (run_.prescribed != nullptr) {
        run_.hand = input.pose;
        run_.prescribed->move_to(input.pose);
        run_.prescribed->press(input.pedal);
        if (input.burr >= 0) run_.prescribed->take_burr(static_cast<std::size_t>(input.burr));
    }
    if (input.ticks > 1) run_.assembly->advance(input.ticks - 1);
    run_.burr_before_mm = run_.assembly->session().newest_state().burr_position_mm;
    run_.assembly->advance(1);
    run_.tool = run_.assembly->session().newest_state();
}

void SteppedSession::step(const HandInput& input) {
    if (has_ended_) throw std::logic_error("the session has ended; make another");
    make_ticks(input);
    if (!run_.fed.empty() && run_.fed.back().is_as(input))
        run_.fed.back().ticks += input.ticks;
    else
        run_.fed.push_back(input);
}

TickState SteppedSession::state() const {
    TickState state{
        .tool = run_.tool, .milling_force_n = milling_force_n(), .removed_in_all_mm3 = removed_in_all_mm3()};
    state.fixture_force_n = run_.assembly->session().fixture_force_n();
    state.spindle_torque_n_mm = spindle_torque_n_mm();
    state.spindle_power_w = power_w(state.spindle_torque_n_mm, loaded_->settings().burrs[run_.tool.burr]);
    state.removed_mm3.reserve(loaded_->labels().size());
    for (const LoadedCase::NamedLabel& one : loaded_->labels())
        state.removed_mm3.push_back(removed_mm3(one.label));
    return state;
}

double SteppedSession::spindle_torque_n_mm() const {
    if (!run_.tool.spindle_on) return 0.0;
    const glm::dvec3 feed_mm_per_s =
        (run_.tool.burr_position_mm - run_.burr_before_mm) / MillingSession::tick_s;
    return osteomill::spindle_torque_n_mm(run_.assembly->session().known_result(),
                                          loaded_->felt_burrs()[run_.tool.burr], feed_mm_per_s);
}

double SteppedSession::removed_in_all_mm3() const {
    double sum_mm3 = 0.0;
    for (const std::size_t label : loaded_->labels_of_bone()) sum_mm3 += removed_mm3(label);
    return sum_mm3;
}

void SteppedSession::replay(const FedMotion& motion, const Pace& pace) {
    if (motion.session != origin_)
        throw std::invalid_argument(fmt::format("the state is of another case or of other settings; {}",
                                                first_difference(motion.session, origin_)));
    if (is_recorded())
        throw std::invalid_argument(
            "a session that is recorded cannot go back: its recording would be of two");
    if (has_ended_) throw std::logic_error("the session has ended; make another");
    Run before = std::move(run_);
    try {
        run_ = {};
        pace([this] { begin(); });
        std::size_t next = 0;
        std::uint64_t made = 0;  // of the next input's ticks
        const auto make_some = [&] {
            for (std::uint64_t left = ticks_at_once; left > 0 && next < motion.inputs.size();) {
                HandInput part = motion.inputs[next];
                part.ticks = std::min(left, part.ticks - made);
                make_ticks(part);
                left -= part.ticks;
                made += part.ticks;
                if (made < motion.inputs[next].ticks) continue;
                ++next;
                made = 0;
            }
        };
        while (next < motion.inputs.size()) pace(make_some);
        run_.fed = motion.inputs;
    } catch (...) {
        run_ = std::move(before);
        throw;
    }
}

double SteppedSession::max_force_n() const {
    return run_.assembly->device().limits().max_force_n;
}

void SteppedSession::end() {
    if (std::exchange(has_ended_, true)) return;
    run_.assembly->end();
    if (run_.assembly->shown() == nullptr) return;
    run_.assembly->shown()->server().stop();
    if (const auto recording = run_.assembly->shown()->server().recording();
        recording && !recording->error.empty())
        throw std::runtime_error(ending_of(*recording));
}

}  // namespace osteomill::python
