#include "simulation/loop/milling_session.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <latch>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <thread>
#include <utility>

#include "simulation/loop/real_time.h"

namespace osteomill {

namespace {

constexpr double chore_period_s = 0.02;
constexpr std::uint64_t chore_ticks = 33;  // the rate of a streaming server's frames: 30 Hz
/// For the rounding of a number of periods against one of ticks.
constexpr double rounding_s = 1e-7;
/// Time that a session waits for the reader of its changes before it gives up on it.
constexpr std::chrono::seconds longest_wait_for_consumer{10};
/// A loop that has not faded its force by then stands still, and its device ends the force by itself.
constexpr double longest_letting_go_s = 0.2;

void require_usable(const std::optional<int>& cpu) {
    const std::vector<int> usable = usable_cpus();
    if (!cpu || std::find(usable.begin(), usable.end(), *cpu) != usable.end()) return;
    throw std::invalid_argument(
        fmt::format("processor {} is not one that this program may use; choose one of {}", *cpu,
                    fmt::join(usable, ", ")));
}

const MillingSessionOptions& validated(const MillingSessionOptions& options) {
    if (!(options.milling_rate_hz >= least_milling_rate_hz &&
          options.milling_rate_hz <= most_milling_rate_hz)) {
        throw std::invalid_argument("milling rate " + std::to_string(options.milling_rate_hz) +
                                    " Hz is out of range; choose 25 to 10000 Hz");
    }
    require_usable(options.haptic_cpu);
    require_usable(options.milling_cpu);
    return options;
}

MillingSessionOptions followed_by_nobody(MillingSessionOptions options) {
    if (options.clock == ClockKind::real || options.repeats_real_clock)
        throw std::invalid_argument("a session of the real clock cannot be copied");
    options.can_be_controlled = options.changes_are_consumed = false;
    return options;
}

/// The tool as shown before the first tick.
ToolState tool_at_start(const Scene& scene) {
    return {.burr_position_mm = scene.start_pose.position_mm,
            .spindle_axis = scene.start_pose.spindle_axis,
            .hand_position_mm = scene.start_pose.position_mm,
            .burr = scene.start_burr};
}

std::vector<double> spindle_speeds(const std::vector<Burr>& burrs) {
    std::vector<double> rev_per_s;
    for (const Burr& burr : burrs) rev_per_s.push_back(burr.spindle_rev_per_s);
    return rev_per_s;
}

/// All fixtures if they may be switched, else those that are on.
FixtureSet fixtures_to_hold(const Scene& scene, const MillingSessionOptions& options) {
    const bool may_be_switched = options.can_be_controlled && entry_of(options.coupling.kind).takes_fixtures;
    return may_be_switched ? fixture_bit(scene.fixtures.size()) - 1 : fixtures_on(scene.fixtures);
}

std::optional<HandpieceVibration> make_vibration(const Scene& scene, const HapticDevice& device,
                                                 const MillingSessionOptions& options) {
    if (!options.vibration) return std::nullopt;
    return HandpieceVibration(felt_burrs(scene), {.max_force_n = device.limits().max_force_n,
                                                  .max_slew_n_per_s = ForceGuard::slew_n_per_s,
                                                  .scale = ArmScale(scene.device.scale)});
}

/// Prepares a thread for its loop, so that the loop finds all it needs.
void prepare_thread(const std::optional<int>& cpu) noexcept {
    if (cpu) bind_to_cpu(*cpu);
    touch_stack();
}

/// Counts the page faults of the thread that calls it once a tick.
class PageFaultCount {
  public:
    void tick() noexcept {
        if (++ticks_ == MillingSession::settling_ticks) at_start_ = page_faults_of_this_thread();
    }
    std::uint64_t since_settled() const noexcept {
        return ticks_ < MillingSession::settling_ticks ? 0 : page_faults_of_this_thread() - at_start_;
    }

  private:
    std::uint64_t ticks_ = 0;
    std::uint64_t at_start_ = 0;
};

/// Polls until `is_done`, a stop or the longest wait.
template <typename IsDone>
void wait_for_consumer(const std::atomic<bool>* stop, IsDone&& is_done) {
    const auto give_up = std::chrono::steady_clock::now() + longest_wait_for_consumer;
    while (!is_done() && std::chrono::steady_clock::now() < give_up) {
        if (stop != nullptr && stop->load(std::memory_order_relaxed)) return;
        std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
}

}  // namespace

MillingSession::MillingSession(const Scene& scene, Bone bone, HapticDevice& device,
                               const MillingSessionOptions& options, SampleLog<TickSample>* log,
                               SampleLog<MillingSample>* milling_log)
    : options_(validated(options)),
      device_(device),
      log_(log),
      milling_log_(milling_log),
      model_(make_force_model(options.force_model, std::move(bone), felt_burrs(scene), scene.tissues)),
      held_fixtures_(fixtures_to_hold(scene, options)),
      coupling_(make_coupling(
          options.coupling,
          {.device = in_patient_space(device.limits(), ArmScale(scene.device.scale)),
           .milling_period_s = std::max(tick_s, 1.0 / options.milling_rate_hz),
           .model_holds_wall = !find_force_model(options.force_model).has_cutting_law,
           .wall_friction = find_force_model(options.force_model).has_friction ? scene.wall_friction : 0.0,
           .feed_forward = scene.feed_forward,
           .fixtures = make_fixtures(
               scene, options.structures,
               in_patient_space(device.limits(), ArmScale(scene.device.scale)).max_stiffness_n_per_mm,
               held_fixtures_)})),
      exchange_(model_->bone(), tool_at_start(scene),
                {.consume_changes = options.changes_are_consumed, .control = options.can_be_controlled}),
      vibration_(make_vibration(scene, device, options)),
      haptic_loop_(haptic_parts(),
                   {.tick_s = tick_s,
                    .mapping = scene.device,
                    .burr_count = scene.burrs.size(),
                    .start_burr = scene.start_burr,
                    .spindle_rev_per_s = spindle_speeds(scene.burrs),
                    .has_shank = has_shank(scene.burrs),
                    .removed_before_mm3 = std::accumulate(options.removed_before_mm3.begin(),
                                                          options.removed_before_mm3.end(), 0.0),
                    .has_fixtures = held_fixtures_ != 0,
                    .fixtures_on = fixtures_on(scene.fixtures),
                    .start_pose = scene.start_pose}),
      burrs_(felt_burrs(scene)),
      milling_loop_(milling_parts(scene.motor), tick_s),
      haptic_ticks_(tick_s, 0.0, haptic_work()),
      milling_steps_(1.0 / options.milling_rate_hz,
                     // On the real clock it finds a fresh command, and is done before the next tick.
                     options.clock == ClockKind::real || options.repeats_real_clock ? 0.5 * tick_s : 0.0,
                     milling_work()) {
    options_.structures.clear();
    exchange_.gate.fixtures_on.store(fixtures_on(scene.fixtures));
}

MillingSession::MillingSession(const MillingSession& other, HapticDevice& device, SampleLog<TickSample>* log)
    : options_(followed_by_nobody(other.options_)),
      device_(device),
      log_(log),
      milling_log_(nullptr),
      model_(other.model_->copy()),
      held_fixtures_(other.held_fixtures_),
      coupling_(other.coupling_->copy()),
      exchange_(other.exchange_, model_->bone()),
      vibration_(other.vibration_),
      haptic_loop_(other.haptic_loop_, haptic_parts()),
      burrs_(other.burrs_),
      milling_loop_(other.milling_loop_, milling_parts({})),
      haptic_ticks_(other.haptic_ticks_, haptic_work()),
      milling_steps_(other.milling_steps_, milling_work()),
      now_s_(other.now_s_),
      ticks_(other.ticks_) {}

HapticLoopParts MillingSession::haptic_parts() noexcept {
    return {.device = device_,
            .coupling = *coupling_,
            .results = exchange_.results,
            .commands = exchange_.commands,
            .tool = exchange_.tool,
            .status = exchange_.status,
            .log = log_,
            .vibration = vibration_ ? &*vibration_ : nullptr,
            .gate = exchange_.restored ? &exchange_.gate : nullptr,
            .placements = exchange_.restored ? &exchange_.placements : nullptr};
}

MillingLoopParts MillingSession::milling_parts(const std::optional<Motor>& motor) noexcept {
    return {.model = *model_,
            .commands = options_.repeats_real_clock ? repeated_commands_ : exchange_.commands,
            .results = exchange_.results,
            .changes = exchange_.changes,
            .log = milling_log_,
            .burrs = burrs_,
            .restored = exchange_.restored.get(),
            .gate = exchange_.restored ? &exchange_.gate : nullptr,
            .cuts = options_.changes_are_consumed ? &exchange_.cuts : nullptr,
            .motor = motor};
}

PeriodicLoop::Work MillingSession::haptic_work() {
    return [this](double time_s, std::uint64_t missed) {
        haptic_loop_.tick(time_s, missed);
        now_s_ = time_s;
    };
}

PeriodicLoop::Work MillingSession::milling_work() {
    return [this, period_s = 1.0 / options_.milling_rate_hz](double time_s, std::uint64_t missed) {
        milling_loop_.step(time_s, period_s * static_cast<double>(1 + missed), missed);
    };
}

void MillingSession::run(const std::atomic<bool>& stop, const OnProgress& on_progress) {
    start();
    if (options_.clock == ClockKind::real)
        run_in_threads(stop, on_progress);
    else
        advance(std::numeric_limits<std::uint64_t>::max(), on_progress, &stop);
    end(on_progress);
}

void MillingSession::start() {
    // Before the device: it takes a while, in which a device would have nobody who watches it.
    if (options_.clock == ClockKind::real) is_memory_locked_ = lock_memory();
    device_.start();
}

void MillingSession::end(const OnProgress& on_progress) {
    device_.stop();
    if (options_.clock == ClockKind::virtual_time) do_chores(on_progress);
    send_what_overflowed();
    do_chores(on_progress);
}

void MillingSession::run_in_threads(const std::atomic<bool>& stop, const OnProgress& on_progress) {
    std::atomic<bool> is_over{false};
    // With memory locked a thread's whole stack is brought in before it starts, which takes milliseconds: the
    // session begins when both threads are there, or its first ticks would be late.
    std::latch prepared(2);
    std::latch begun(1);
    std::optional<RealClock> clock;
    const auto run_loop = [&](PeriodicLoop& loop, int priority, const std::optional<int>& cpu,
                              LoopThread& thread) {
        prepare_thread(cpu);
        PageFaultCount faults;
        thread.has_real_time_priority = ask_for_real_time(priority);
        prepared.count_down();
        begun.wait();
        while (!is_over.load(std::memory_order_relaxed)) {
            loop.wait_and_tick(*clock);
            faults.tick();
        }
        thread.page_faults = faults.since_settled();
    };
    std::thread haptic(
        [&] { run_loop(haptic_ticks_, haptic_priority, options_.haptic_cpu, haptic_thread_); });
    std::thread milling(
        [&] { run_loop(milling_steps_, milling_priority, options_.milling_cpu, milling_thread_); });

    prepared.wait();
    clock.emplace();
    if (log_ != nullptr) log_->begin();
    begun.count_down();

    while (!stop.load(std::memory_order_relaxed) && clock->now_s() < options_.duration_s) {
        do_chores(on_progress);
        clock->sleep_until(std::min(clock->now_s() + chore_period_s, options_.duration_s));
    }
    // No force ends in one step, that of a session neither.
    haptic_loop_.let_go();
    const double longest_s = clock->now_s() + longest_letting_go_s;
    while (!haptic_loop_.has_let_go() && clock->now_s() < longest_s)
        clock->sleep_until(clock->now_s() + tick_s);
    is_over.store(true, std::memory_order_relaxed);
    haptic.join();
    milling.join();
    haptic_loop_.settle(milling_loop_.total_removed_mm3(), milling_loop_.restored_changes());
}

std::uint64_t MillingSession::advance(std::uint64_t ticks, const OnProgress& on_progress,
                                      const std::atomic<bool>* stop) {
    const RealClock stopwatch;  // measures how long the work takes; nothing depends on it
    const std::uint64_t before = ticks_;
    while (ticks_ - before < ticks && haptic_ticks_.due_s() <= options_.duration_s) {
        if (stop != nullptr && stop->load(std::memory_order_relaxed)) break;
        haptic_ticks_.tick_now(stopwatch);
        while (milling_steps_.due_s() <= now_s_ + rounding_s) {
            milling_steps_.tick_now(stopwatch);
            if (exchange_.changes.has_overflowed()) wait_for_room_in_queue(stop, on_progress);
        }
        haptic_loop_.settle(milling_loop_.total_removed_mm3(), milling_loop_.restored_changes());
        if (ticks_++ % chore_ticks == 0) do_chores(on_progress);
    }
    return ticks_ - before;
}

void MillingSession::repeat_tick(std::span<const StepTrace> steps, std::uint64_t missed) {
    for (const StepTrace& step : steps) repeat_step(step);
    haptic_ticks_.tick_after(missed, RealClock());
    exchange_.commands.refresh();
    const BurrCommand& command = exchange_.commands.front();
    given_commands_[command.tick % given_commands_.size()] = command;
    if (ticks_++ % chore_ticks == 0) do_chores({});
}

void MillingSession::repeat_step(const StepTrace& step) {
    const BurrCommand& command = given_commands_[step.command % given_commands_.size()];
    if (command.tick != step.command || (repeated_command_ && step.command < *repeated_command_))
        throw std::invalid_argument(
            fmt::format("a milling step went to the command of tick {}, which is none", step.command));
    if (repeated_command_ != step.command) {
        repeated_commands_.back() = command;
        repeated_commands_.publish();
        repeated_command_ = step.command;
    }
    milling_steps_.tick_after(step.missed, RealClock());
}

void MillingSession::repeat_step_at_end() {
    exchange_.commands.refresh();
    repeat_step({.command = exchange_.commands.front().tick});
}

void MillingSession::do_chores(const OnProgress& on_progress) {
    const auto drain = [this](auto* log) {
        if (log == nullptr) return;
        options_.clock == ClockKind::real ? log->drain() : log->drain_all();
    };
    drain(log_);
    drain(milling_log_);
    exchange_.status.refresh();
    if (on_progress) on_progress(exchange_.status.front());
}

void MillingSession::wait_for_room_in_queue(const std::atomic<bool>* stop, const OnProgress& on_progress) {
    do_chores(on_progress);
    wait_for_consumer(stop, [this] {
        exchange_.changes.resend_overflowed(model_->bone());
        return !exchange_.changes.has_overflowed();
    });
}

void MillingSession::send_what_overflowed() {
    wait_for_consumer(nullptr, [this] {
        exchange_.changes.resend_overflowed(model_->bone());
        return !exchange_.changes.has_overflowed();
    });
}

MillingSessionReport MillingSession::report() const {
    return {.duration_s = now_s_,
            .haptic = haptic_ticks_.statistics(),
            .milling = milling_steps_.statistics(),
            .removed_mm3 = model_->removed_mm3(),
            .removed_before_mm3 = options_.removed_before_mm3,
            .peak_force_n = haptic_loop_.peak_force_n(),
            .most_energy_to_hand_mj = haptic_loop_.most_energy_to_hand_mj(),
            .solve = coupling_->solve_counts(),
            .fault_counts = haptic_loop_.fault_counts(),
            .change_overflows = exchange_.changes.overflow_count(),
            .bone_checksum = checksum(model_->bone()),
            .real_time_priority = haptic_thread_.has_real_time_priority,
            .memory_locked = is_memory_locked_,
            .haptic_page_faults = haptic_thread_.page_faults,
            .milling_page_faults = milling_thread_.page_faults};
}

}  // namespace osteomill
