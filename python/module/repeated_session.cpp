#include "python/module/repeated_session.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <iterator>
#include <limits>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include "common/recording/playhead.h"
#include "common/scene/scene_file.h"
#include "common/session/seen_steps.h"
#include "common/session/tick_sample.h"
#include "common/text/foreign_text.h"
#include "common/text/words.h"
#include "devices/simulated/hand_and_arm.h"
#include "devices/simulated/prescribed_device.h"
#include "haptic_server/session/recorded_arm.h"
#include "imaging/case/structures.h"
#include "simulation/loop/milling_session.h"
#include "simulation/safety/fault.h"

namespace osteomill {

namespace {

/// Why a session cannot be computed again, in one line.
class NotRepeatable : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

constexpr const char* only_to_four_decimals =
    "its poses are written with four decimals: it repeats to 0.1 um only (recorded by a version of protocol "
    "2.2 or before)";

const std::string& setting(const SessionInfo& session, const std::string& name) {
    const auto found = session.settings.find(name);
    if (found == session.settings.end())
        throw NotRepeatable(fmt::format("it does not say its setting '{}'", name));
    return found->second;
}

double number_of(const SessionInfo& session, const std::string& name) {
    const std::optional<double> number = finite_number(setting(session, name));
    if (!number) throw NotRepeatable(fmt::format("its setting '{}' is no number", name));
    return *number;
}

DeviceLimits arm_of(const SessionInfo& session) {
    try {
        return arm_of_settings(setting(session, "arm"), "its setting 'arm'");
    } catch (const std::runtime_error& error) {
        throw NotRepeatable(error.what());
    }
}

Scene scene_of(const SessionInfo& session) {
    if (session.scene_toml.empty())
        throw NotRepeatable(session.holds_ticks ? only_to_four_decimals : "it does not say its scene");
    try {
        return parse_scene(session.scene_toml, "the recorded scene");
    } catch (const SceneError& error) {
        throw NotRepeatable(error.what());
    }
}

CouplingChoice coupling_of(const SessionInfo& session) {
    try {
        return coupling_named(setting(session, "coupling"));
    } catch (const std::invalid_argument& error) {
        throw NotRepeatable(error.what());
    }
}

MillingSessionOptions options_of(const SessionInfo& session) {
    const CouplingChoice coupling = coupling_of(session);
    if (coupling.addition == CouplingAddition::damper && setting(session, "device") != "prescribed" &&
        setting(session, "grip") != rails_name)
        throw NotRepeatable("its coupling " + name_of(coupling) +
                            " takes the arm's own velocity, which is not recorded");
    MillingSessionOptions options{.clock = ClockKind::virtual_time,
                                  .milling_rate_hz = number_of(session, "milling_rate_hz"),
                                  .coupling = coupling,
                                  .force_model = setting(session, "force_model"),
                                  .vibration = setting(session, "vibration") == "true",
                                  .can_be_controlled = true,
                                  .repeats_real_clock = setting(session, "clock") == "real"};
    options.removed_before_mm3[0] = number_of(session, "removed_before_mm3");
    return options;
}

/// The changes with which undo gave bone back, or redo took it away again, in the order in which they were
/// queued: frame by frame, and brick by brick.
class RestoredChanges {
  public:
    /// For each frame: its own and, if there is one, the next frame's, which may come behind its ticks.
    void arrive(const std::vector<ChangedBrick>& changes, const StateArrived* next) {
        if (!std::exchange(has_next_, false)) add(changes);
        next_ = next != nullptr ? &next->changes : nullptr;
    }
    /// Queues the next `count` of them, or all that are left.
    void queue(std::uint32_t count, ChangeQueue& to) {
        if (waiting_.size() < count && next_ != nullptr && !std::exchange(has_next_, true)) add(*next_);
        for (; count > 0 && !waiting_.empty(); --count, waiting_.pop_front())
            if (!to.try_push(waiting_.front().change, waiting_.front().fractions)) return;
    }

  private:
    void add(const std::vector<ChangedBrick>& changes) {
        std::vector<ChangedBrick> restored;
        std::ranges::copy_if(changes, std::back_inserter(restored),
                             [](const ChangedBrick& c) { return c.change.kind == ChangeKind::restored; });
        std::ranges::stable_sort(restored, {}, [](const ChangedBrick& c) { return c.change.brick; });
        waiting_.insert(waiting_.end(), restored.begin(), restored.end());
    }

    std::deque<ChangedBrick> waiting_;
    const std::vector<ChangedBrick>* next_ = nullptr;
    bool has_next_ = false;  // they are in waiting_
};

class KeptTicks final : public SampleLog<TickSample> {
  public:
    void push(const TickSample& sample) noexcept override { last_ = sample; }
    void drain() override {}
    void drain_all() override {}
    std::optional<TickSample> take() { return std::exchange(last_, std::nullopt); }

  private:
    std::optional<TickSample> last_;
};

class Repeat {
  public:
    Repeat(const std::filesystem::path& file, RepeatedSession& result) : playhead_(file), result_(result) {}

    void run(const std::function<void(double)>& on_progress) {
        for (;;) {
            on_progress(playhead_.share_read());
            const Playhead::Step step = playhead_.step(std::numeric_limits<double>::infinity());
            if (step == Playhead::Step::new_bone) throw NotRepeatable("several sessions were joined in it");
            if (step == Playhead::Step::goodbye || step == Playhead::Step::end) break;
            if (!take_state()) return;
        }
        end();
    }

  private:
    /// False if something differs.
    bool take_state() {
        if (!playhead_.session().holds_ticks) throw NotRepeatable("it holds no ticks");
        restored_.arrive(playhead_.changes(), playhead_.next_state());
        if (playhead_.counts().missed_ticks > 0) throw NotRepeatable("ticks are missing from it");
        for (const TickSample& tick : playhead_.ticks()) {
            if (!session_) begin(tick);
            if (!take_tick(tick)) return false;
        }
        // On the real clock steps of the tick under way may be in the bone, or not yet.
        if (is_real_ || !session_) return true;
        ++result_.states;
        if (checksum(session_->bone()) == playhead_.bone_checksum()) return true;
        return differs(fmt::format("the bone's checksum is {:016x}, recorded {:016x}",
                                   checksum(session_->bone()), playhead_.bone_checksum()));
    }

    void begin(const TickSample& first) {
        if (!first.input) throw NotRepeatable(only_to_four_decimals);
        const SessionInfo& info = playhead_.session();
        const Scene scene = scene_of(info);
        MillingSessionOptions options = options_of(info);
        fixtures_on_ = fixtures_on(scene.fixtures);
        if (!scene.fixtures.empty()) {
            options.structures = playhead_.structures();
            add_structures_in_bone(scene, *start_, options.structures);
        }
        is_real_ = options.repeats_real_clock;
        if (is_real_ && options.milling_rate_hz != 1.0 / MillingSession::tick_s)
            throw NotRepeatable(
                "its milling loop ran at another rate than its haptic loop, on the real clock");
        device_ = std::make_unique<RecordedDevice>(arm_of(info), scene.device);
        try {
            session_ = std::make_unique<MillingSession>(scene, *start_, *device_, options, &made_);
        } catch (const std::invalid_argument& error) {
            throw NotRepeatable(error.what());
        }
        session_->start();
    }

    bool take_tick(const TickSample& recorded) {
        if (!recorded.input) throw NotRepeatable(only_to_four_decimals);
        const std::uint64_t tick = ticks_++;
        device_->say(recorded);
        control(recorded);
        if (recorded.input->lets_go) session_->let_go();
        if (!is_real_) {
            give_back(recorded);
            session_->advance(1);
            const std::optional<TickSample> made = made_.take();
            return made && is_as(recorded, *made, tick);
        }
        const auto steps = steps_of_code(recorded.input->steps, tick);
        if (!steps)
            throw NotRepeatable(fmt::format("it does not say which milling steps came before tick {}", tick));
        const auto missed =
            std::llround((recorded.time_s - session_->next_tick_s()) / MillingSession::tick_s);
        if (missed < 0) throw NotRepeatable(fmt::format("tick {} comes too early", tick));
        if (before_) give_back(*before_);
        try {
            session_->repeat_tick(*steps, static_cast<std::uint64_t>(missed));
        } catch (const std::invalid_argument& error) {
            throw NotRepeatable(error.what());
        }
        // Its row has the volume removed until the next.
        const std::optional<TickSample> before = made_.take();
        const bool is_equal = !before_ || (before && is_as(*before_, *before, tick - 1));
        before_ = recorded;
        return is_equal;
    }

    /// As those who controlled the session did, before the tick.
    void control(const TickSample& recorded) {
        constexpr auto paused = static_cast<std::uint8_t>(Fault::paused);
        const bool is_pause_new = std::exchange(fault_, recorded.fault) != paused && recorded.fault == paused;
        if (is_pause_new && !recorded.input->holds_still)
            throw NotRepeatable(
                fmt::format("its ticks do not say what held it still at {:.3f} s (recorded by an earlier "
                            "version)",
                            recorded.time_s));
        SessionGate& gate = session_->exchange().gate;
        gate.stillness.set(recorded.input->holds_still);
        gate.fixtures_on.store(fixtures_on_ ^ recorded.input->switched);
        gate.spindle_rpm.store(recorded.input->chosen_rpm);
        if (!recorded.input->is_placed) return;
        TripleBuffer<Placement>& placements = session_->exchange().placements;
        placements.back() = {.number = ++placements_, .pose = {recorded.hand_mm, recorded.spindle_axis}};
        placements.publish();
    }

    /// The bone that came back until the tick after this one.
    void give_back(const TickSample& recorded) {
        restored_.queue(recorded.input->restored, *session_->exchange().restored);
    }

    bool is_as(const TickSample& recorded, const TickSample& made, std::uint64_t tick) {
        ++result_.ticks;
        for (const TickQuantity& quantity : tick_quantities()) {
            if (!quantity.is_of(recorded)) continue;
            // The order of the loops is the real clock's, not theirs.
            const bool is_input = quantity.part == TickPart::input || quantity.part == TickPart::control;
            if (is_input && !is_real_) continue;
            if (to_code(quantity.of(recorded), quantity.decimals) ==
                to_code(quantity.of(made), quantity.decimals))
                continue;
            result_.tick = tick;
            result_.time_s = recorded.time_s;
            return differs(fmt::format("{} is {:.{}f}, recorded {:.{}f}", quantity.name, quantity.of(made),
                                       quantity.decimals, quantity.of(recorded), quantity.decimals));
        }
        return true;
    }

    void end() {
        if (!session_) throw NotRepeatable("it has no tick");
        if (before_) give_back(*before_);
        // A step or two may have come behind the last tick of the real clock.
        for (int more = 0; is_real_ && more < 3 && checksum(session_->bone()) != playhead_.bone_checksum();
             ++more)
            session_->repeat_step_at_end();
        ++result_.states;
        result_.is_equal = checksum(session_->bone()) == playhead_.bone_checksum();
        if (!result_.is_equal) differs("the bone at its end has another checksum");
    }

    bool differs(std::string what) {
        result_.difference = std::move(what);
        return false;
    }

    Playhead playhead_;
    std::optional<Bone> start_{playhead_.bone()};
    RepeatedSession& result_;
    KeptTicks made_;
    std::unique_ptr<RecordedDevice> device_;
    std::unique_ptr<MillingSession> session_;
    bool is_real_ = false;
    FixtureSet fixtures_on_ = 0;  // as the scene says
    std::uint8_t fault_ = 0;      // in the tick before
    RestoredChanges restored_;
    std::uint64_t placements_ = 0;
    std::uint64_t ticks_ = 0;
    std::optional<TickSample> before_;
};

}  // namespace

std::string RepeatedSession::line() const {
    if (is_equal) return fmt::format("equal to the bit: {} ticks, and the bone {} times", ticks, states);
    if (tick) return fmt::format("differs first at tick {} ({:.4f} s): {}", *tick, time_s, difference);
    return ticks == 0 ? fmt::format("cannot be repeated to the bit: {}", difference)
                      : fmt::format("differs behind tick {}: {}", ticks - 1, difference);
}

RepeatedSession repeat_session(const std::filesystem::path& file,
                               const std::function<void(double)>& on_progress) {
    RepeatedSession result;
    try {
        Repeat(file, result).run(on_progress);
    } catch (const NotRepeatable& why) {
        result.ticks = 0;
        result.difference = printable(why.what());
    }
    return result;
}

}  // namespace osteomill
