#include "haptic_server/loop/milling_session.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <latch>
#include <optional>
#include <stdexcept>
#include <thread>
#include <utility>

#include "haptic_server/loop/real_time.h"
#include "haptic_server/loop/thread_priority.h"

namespace osteomill {

namespace {

constexpr double chore_period_s = 0.02;
constexpr std::uint64_t chore_ticks = 33;  // the rate of a streaming server's frames: 30 Hz
/// How long a session waits for whoever consumes its edits before it gives up on them.
constexpr std::chrono::seconds longest_wait_for_consumer{10};

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

/// What is shown before the first tick.
ToolState tool_at_start(const Scene& scene) {
    return {.burr_position_mm = scene.start_pose.position_mm,
            .spindle_axis = scene.start_pose.spindle_axis,
            .hand_position_mm = scene.start_pose.position_mm,
            .burr = scene.start_burr};
}

/// What a thread does before its loop, so that the loop finds all it needs.
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
                               const MillingSessionOptions& options, ForceLog* log, MillingLog* milling_log)
    : options_(validated(options)),
      device_(device),
      log_(log),
      milling_log_(milling_log),
      model_(make_force_model(options.force_model, std::move(bone), scene.burrs, scene.tissues)),
      coupling_(make_coupling(
          options.coupling,
          {.device = device.limits(),
           .milling_period_s = std::max(tick_s, 1.0 / options.milling_rate_hz),
           .position_resolution_mm = device.limits().position_resolution_mm * scene.device.scale,
           .model_holds_wall = !find_force_model(options.force_model).has_cutting_law})),
      edits_(edit_queue_runs, model_->bone().shared_content()),
      tool_(tool_at_start(scene)),
      status_(tool_at_start(scene)),
      haptic_loop_({.device = device,
                    .coupling = *coupling_,
                    .results = results_,
                    .commands = commands_,
                    .tool = tool_,
                    .status = status_,
                    .log = log},
                   {.tick_s = tick_s,
                    .mapping = scene.device,
                    .burr_count = scene.burrs.size(),
                    .start_burr = scene.start_burr,
                    .start_pose = scene.start_pose}),
      milling_loop_(
          {.model = *model_, .commands = commands_, .results = results_, .edits = edits_, .log = milling_log},
          tick_s) {}

void MillingSession::run(const std::atomic<bool>& stop,
                         const std::function<void(const ToolState&)>& on_progress) {
    // Before the device: it takes a while, in which a device would have nobody who watches it.
    if (options_.clock == ClockKind::real) is_memory_locked_ = lock_memory();
    device_.start();
    if (options_.clock == ClockKind::real) {
        run_in_threads(stop, on_progress);
    } else {
        run_in_lock_step(stop, on_progress);
    }
    device_.stop();
    if (options_.clock == ClockKind::virtual_time) do_chores(on_progress);
    send_what_overflowed();
    do_chores(on_progress);
}

void MillingSession::run_in_threads(const std::atomic<bool>& stop,
                                    const std::function<void(const ToolState&)>& on_progress) {
    std::atomic<bool> is_over{false};
    // With memory locked a thread's whole stack is brought in before it starts, which takes milliseconds: the
    // session begins when both threads are there, or its first ticks would be late.
    std::latch prepared(2);
    std::latch begun(1);
    std::optional<RealClock> clock;
    std::thread haptic([&] {
        prepare_thread(options_.haptic_cpu);
        PageFaultCount faults;
        has_real_time_priority_.store(ask_for_real_time(haptic_priority));
        prepared.count_down();
        begun.wait();
        run_periodically(*clock, tick_s, 0.0, is_over, haptic_statistics_,
                         [&](double time_s, std::uint64_t missed) {
                             haptic_loop_.tick(time_s, missed);
                             now_s_.store(time_s, std::memory_order_relaxed);
                             faults.tick();
                             return true;
                         });
        haptic_page_faults_ = faults.since_settled();
    });
    const double period_s = 1.0 / options_.milling_rate_hz;
    std::thread milling([&] {
        prepare_thread(options_.milling_cpu);
        PageFaultCount faults;
        ask_for_real_time(milling_priority);
        prepared.count_down();
        begun.wait();
        // Half a tick after the haptic loop: it finds a fresh command and is done before the next tick.
        run_periodically(*clock, period_s, 0.5 * tick_s, is_over, milling_statistics_,
                         [&](double time_s, std::uint64_t missed) {
                             milling_loop_.step(time_s, period_s * static_cast<double>(1 + missed));
                             faults.tick();
                             return true;
                         });
        milling_page_faults_ = faults.since_settled();
    });

    prepared.wait();
    clock.emplace();
    begun.count_down();

    while (!stop.load(std::memory_order_relaxed) && clock->now_s() < options_.duration_s) {
        do_chores(on_progress);
        clock->sleep_until(std::min(clock->now_s() + chore_period_s, options_.duration_s));
    }
    is_over.store(true, std::memory_order_relaxed);
    haptic.join();
    milling.join();
}

void MillingSession::run_in_lock_step(const std::atomic<bool>& stop,
                                      const std::function<void(const ToolState&)>& on_progress) {
    RealClock stopwatch;  // measures how long the work takes; nothing depends on it
    const double period_s = 1.0 / options_.milling_rate_hz;
    for (std::uint64_t tick = 0; !stop.load(std::memory_order_relaxed); ++tick) {
        const double time_s = static_cast<double>(tick) * tick_s;
        if (time_s > options_.duration_s) break;

        const double tick_began_s = stopwatch.now_s();
        haptic_loop_.tick(time_s, 0);
        haptic_statistics_.duration.add(stopwatch.now_s() - tick_began_s);
        ++haptic_statistics_.ticks;
        now_s_.store(time_s, std::memory_order_relaxed);

        // A tenth of a microsecond for the rounding of k * period against tick * tick_s.
        while (static_cast<double>(milling_statistics_.ticks) * period_s <= time_s + 1e-7) {
            const double step_s = static_cast<double>(milling_statistics_.ticks) * period_s;
            const double step_began_s = stopwatch.now_s();
            milling_loop_.step(step_s, period_s);
            milling_statistics_.duration.add(stopwatch.now_s() - step_began_s);
            ++milling_statistics_.ticks;
            if (edits_.has_overflowed()) wait_for_room_in_queue(stop, on_progress);
        }
        if (tick % chore_ticks == 0) do_chores(on_progress);
    }
}

void MillingSession::do_chores(const std::function<void(const ToolState&)>& on_progress) {
    const auto drain = [this](auto* log) {
        if (log == nullptr) return;
        options_.clock == ClockKind::real ? log->drain() : log->drain_all();
    };
    drain(log_);
    drain(milling_log_);
    if (!options_.edits_are_consumed) edits_.consume_all([](const EditRun&) {});
    status_.refresh();
    if (on_progress) on_progress(status_.front());
}

void MillingSession::wait_for_room_in_queue(const std::atomic<bool>& stop,
                                            const std::function<void(const ToolState&)>& on_progress) {
    do_chores(on_progress);
    wait_for_consumer(&stop, [this] {
        edits_.resend_overflowed(model_->bone());
        return !edits_.has_overflowed();
    });
}

void MillingSession::send_what_overflowed() {
    wait_for_consumer(nullptr, [this] {
        if (!options_.edits_are_consumed) edits_.consume_all([](const EditRun&) {});
        edits_.resend_overflowed(model_->bone());
        return !edits_.has_overflowed();
    });
}

MillingSessionReport MillingSession::report() const {
    return {.duration_s = now_s_.load(std::memory_order_relaxed),
            .haptic = haptic_statistics_,
            .milling = milling_statistics_,
            .removed_mm3 = model_->removed_mm3(),
            .peak_force_n = haptic_loop_.peak_force_n(),
            .fault_counts = haptic_loop_.fault_counts(),
            .edit_overflows = edits_.overflow_count(),
            .bone_checksum = checksum(model_->bone()),
            .real_time_priority = has_real_time_priority_.load(),
            .memory_locked = is_memory_locked_,
            .haptic_page_faults = haptic_page_faults_,
            .milling_page_faults = milling_page_faults_};
}

}  // namespace osteomill
