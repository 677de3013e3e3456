#include "python/module/stepped_session.h"

#include <fmt/format.h>

#include <chrono>
#include <stdexcept>
#include <utility>

#include "haptic_server/session/device_table.h"
#include "haptic_server/session/session_defaults.h"
#include "haptic_server/session/session_settings.h"

namespace osteomill::python {

namespace {

MillingSessionOptions milling_options(const SteppedOptions& options) {
    MillingSessionOptions milling{.clock = ClockKind::virtual_time,
                                  .coupling = options.coupling,
                                  .force_model = options.force_model,
                                  .vibration = options.vibration,
                                  // Whoever steps it ends it, also one that follows a trajectory without end.
                                  .duration_s = std::numeric_limits<double>::max()};
    if (milling.coupling.empty())
        milling.coupling =
            usual_coupling(find_force_model(options.force_model).has_cutting_law, devices().front());
    milling.milling_rate_hz =
        options.milling_rate_hz.value_or(usual_milling_rate_hz(milling.coupling, milling.force_model));
    return milling;
}

std::string fingerprint_of(const LoadedCase& loaded, const SteppedOptions& options) {
    const MillingSessionOptions milling = milling_options(options);
    const ToolPose start = options.start.value_or(loaded.settings().start_pose);
    return fmt::format(
        "{}: bone {:016x}, start {} {} {} {} {} {}, hand {}, coupling {}, force model {}, {} Hz{}",
        loaded.name(), loaded.bone_checksum(), start.position_mm.x, start.position_mm.y, start.position_mm.z,
        start.spindle_axis.x, start.spindle_axis.y, start.spindle_axis.z,
        !options.grip                  ? "prescribed"
        : *options.grip == Grip::light ? "light"
                                       : "firm",
        milling.coupling, milling.force_model, milling.milling_rate_hz,
        options.vibration ? ", vibration" : "");
}

}  // namespace

SteppedSession::SteppedSession(std::shared_ptr<const LoadedCase> loaded, SteppedOptions options)
    : loaded_(std::move(loaded)),
      options_(std::move(options)),
      fingerprint_(fingerprint_of(*loaded_, options_)) {
    begin();
}

SteppedSession::~SteppedSession() {
    try {
        end();
    } catch (const std::exception&) {
        // Who wants to know whether a recording is whole ends the session.
    }
}

void SteppedSession::begin() {
    SessionScene scene = loaded_->scene();
    if (options_.start) scene.scene.start_pose = *options_.start;
    hand_ = scene.scene.start_pose;
    DeviceParts parts;
    if (options_.grip) {
        parts = simulated_hand(scene.scene, *options_.grip);
        simulated_ = parts.simulated;
    } else {
        auto prescribed = std::make_unique<PrescribedDevice>(hand_, scene.scene.device);
        prescribed_ = prescribed.get();
        parts.device = std::move(prescribed);
    }
    SessionOptions session{.milling = milling_options(options_)};
    if (options_.record) {
        session.shown.emplace();
        session.shown->streaming.listens = false;
        session.shown->streaming.record =
            RecordTo{.file = *options_.record, .began = std::chrono::system_clock::now()};
        session.shown->accepts_controls = false;
        session.shown->case_name = loaded_->name();
        session.shown->version = OSTEOMILL_VERSION;
        session.shown->settings = as_texts(session_settings(
            session.milling, loaded_->choice(), scene.scene, options_.grip ? "simulated" : "prescribed",
            options_.grip.value_or(Grip::firm), OSTEOMILL_VERSION));
    }
    // The one before, if any, goes only once there is another.
    assembly_ = std::make_unique<SessionAssembly>(std::move(scene), std::move(parts), std::move(session));
    assembly_->start();
    assembly_->advance(1);
    tool_ = assembly_->session().newest_state();
    fed_.clear();
}

void SteppedSession::make_ticks(const HandInput& input) {
    if (prescribed_ != nullptr) {
        hand_ = input.pose;
        prescribed_->move_to(input.pose);
        prescribed_->press(input.pedal);
        if (input.burr >= 0) prescribed_->take_burr(static_cast<std::size_t>(input.burr));
    }
    assembly_->advance(input.ticks);
    tool_ = assembly_->session().newest_state();
}

void SteppedSession::step(const HandInput& input) {
    if (has_ended_) throw std::logic_error("the session has ended; make another");
    make_ticks(input);
    if (!fed_.empty() && fed_.back().is_as(input))
        fed_.back().ticks += input.ticks;
    else
        fed_.push_back(input);
}

TickState SteppedSession::state() const {
    TickState state{
        .tool = tool_, .milling_force_n = milling_force_n(), .removed_in_all_mm3 = removed_in_all_mm3()};
    state.removed_mm3.reserve(loaded_->labels().size());
    for (const LoadedCase::NamedLabel& one : loaded_->labels())
        state.removed_mm3.push_back(removed_mm3(one.label));
    return state;
}

double SteppedSession::removed_in_all_mm3() const {
    double sum_mm3 = 0.0;
    for (const std::size_t label : loaded_->labels_of_bone()) sum_mm3 += removed_mm3(label);
    return sum_mm3;
}

void SteppedSession::replay(const FedMotion& motion) {
    if (motion.session != fingerprint_)
        throw std::invalid_argument(fmt::format("the state is of another session ({}); this one is {}",
                                                motion.session, fingerprint_));
    if (is_recorded())
        throw std::invalid_argument(
            "a session that is recorded cannot go back: its recording would be of two");
    if (has_ended_) throw std::logic_error("the session has ended; make another");
    std::vector<HandInput> inputs = motion.inputs;
    begin();
    for (const HandInput& input : inputs) make_ticks(input);
    fed_ = std::move(inputs);
}

void SteppedSession::end() {
    if (std::exchange(has_ended_, true)) return;
    assembly_->end();
    if (assembly_->shown() == nullptr) return;
    assembly_->shown()->server().stop();
    if (const auto recording = assembly_->shown()->server().recording();
        recording && !recording->error.empty())
        throw std::runtime_error(recording->error);
}

}  // namespace osteomill::python
