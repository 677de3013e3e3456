// A milling session: device, coupling, haptic loop, milling loop and clock, from start to stop.
//
// There are two loops, haptic at 1 kHz and milling, the same on either clock. On the real clock each has a
// thread that waits for its next tick, and the caller's thread does the work without deadlines. On the
// virtual clock they take turns on the caller's thread, as fast as they can: after each haptic tick run the
// milling steps that are due by then; the next tick sees their result. So the session is a pure function of
// scene, bone and device: same in, bit-equal out.
#pragma once

#include <array>
#include <atomic>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/bone/bone.h"
#include "common/scene/scene.h"
#include "common/session/tick_sample.h"
#include "simulation/coupling/couplings.h"
#include "simulation/device/haptic_device.h"
#include "simulation/exchange/sample_log.h"
#include "simulation/exchange/session_exchange.h"
#include "simulation/force_models/force_model.h"
#include "simulation/force_models/force_models.h"
#include "simulation/loop/haptic_loop.h"
#include "simulation/loop/milling_loop.h"
#include "simulation/loop/periodic_loop.h"

namespace osteomill {

enum class ClockKind { real, virtual_time };

/// Milling rates that a session takes. Below the least, the watchdog's 50 ms without a fresh result could
/// pass between two steps; the most shows ten instants of a tooth period at 10 000 rpm and six edges.
inline constexpr double least_milling_rate_hz = 25.0;
inline constexpr double most_milling_rate_hz = 10'000.0;

struct MillingSessionOptions {
    ClockKind clock = ClockKind::real;
    double milling_rate_hz = 1000.0;
    CouplingChoice coupling{};
    std::string force_model =
        force_model_names().front();  ///< one without a cutting law: not with "implicit"
    bool vibration = false;           ///< the handpiece vibrates; only with a cutting law
    double duration_s = std::numeric_limits<double>::infinity();
    /// The removed volume of a bone that was carved before: the report continues from it.
    RemovedByTissue removed_before_mm3{};
    /// Somebody may pause it, and undo milling: see SessionExchange.
    bool can_be_controlled = false;
    /// Somebody consumes the changes while the session runs. If not, none are queued.
    bool changes_are_consumed = false;
    /// Its loops take turns as those of a session of the real clock did: only with repeat_tick().
    bool repeats_real_clock = false;
    /// Processors that the loops are bound to, of those that this process may use; absent: the system's
    /// choice.
    std::optional<int> haptic_cpu{};
    std::optional<int> milling_cpu{};
    /// Those of the scene's protected tissues, for its fixtures; not kept.
    std::vector<Structure> structures{};
};

struct MillingSessionReport {
    double duration_s = 0.0;  ///< session time at the last haptic tick
    PeriodicStatistics haptic;
    PeriodicStatistics milling;
    RemovedByTissue removed_mm3{};         ///< by this session
    RemovedByTissue removed_before_mm3{};  ///< from the options
    double peak_force_n = 0.0;
    double most_energy_to_hand_mj = 0.0;  ///< net energy that the force gave the hand, the most that it was
    SolveCounts solve;                    ///< for a coupling that solves
    std::array<std::uint64_t, HapticLoop::fault_kinds> fault_counts{};  ///< index = Fault
    std::uint64_t change_overflows = 0;
    std::uint64_t bone_checksum = 0;
    bool real_time_priority = false;  ///< the haptic loop ran under SCHED_FIFO
    bool memory_locked = false;       ///< no page can have been away
    /// Pages that the loops waited for, real clock only, from their hundredth tick on.
    std::uint64_t haptic_page_faults = 0;
    std::uint64_t milling_page_faults = 0;
};

class MillingSession {
  public:
    static constexpr double tick_s = 0.001;
    /// Ticks after which a loop has touched all its memory.
    static constexpr std::uint64_t settling_ticks = 100;
    /// `device` and the logs (may be null) outlive the session. Throws std::invalid_argument for a milling
    /// rate out of range, a processor that this process may not use, an unknown force model, a
    /// coupling that the force model has no law for or that takes no fixtures where the scene has some, or a
    /// scene that the parts refuse.
    MillingSession(const Scene& scene, Bone bone, HapticDevice& device, const MillingSessionOptions& options,
                   SampleLog<TickSample>* log = nullptr, SampleLog<MillingSample>* milling_log = nullptr);
    /// Another on the virtual clock that goes on where `other` is, between two calls of its advance(): with
    /// the same device the same to the bit. It is followed and controlled by nobody. `device`, already
    /// started and where that of `other` is, and the log outlive it. Throws std::invalid_argument for a
    /// session of the real clock.
    MillingSession(const MillingSession& other, HapticDevice& device, SampleLog<TickSample>* log = nullptr);
    MillingSession& operator=(const MillingSession&) = delete;

    /// For the streaming server and others that follow or control the session.
    SessionExchange& exchange() { return exchange_; }

    /// Called on the caller's thread: about every 20 ms, on the virtual clock every 33 ms of the session, if
    /// it may consume the changes.
    using OnProgress = std::function<void(const ToolState&)>;

    /// Starts the device, runs until the duration has passed or `stop` is set, stops the device. Throws what
    /// device.start() throws. Runs once.
    void run(const std::atomic<bool>& stop, const OnProgress& on_progress = {});

    // Or, on the virtual clock, in steps: start(), advance() any number of times, end(). The session is the
    // same to the bit however its ticks are divided.

    /// Throws as device.start() does.
    void start();
    /// Makes so many ticks, fewer if the duration is over or `stop` is set; returns how many.
    std::uint64_t advance(std::uint64_t ticks, const OnProgress& on_progress = {},
                          const std::atomic<bool>* stop = nullptr);
    // Or as recorded of a session on the real clock; with repeats_real_clock, after start().
    /// The steps that the tick was the first to see, then the tick, after so many that were missed. Throws
    /// std::invalid_argument for a step to a command that was never given.
    void repeat_tick(std::span<const StepTrace> steps, std::uint64_t missed);
    /// One more step to the newest command: the last may have come behind the last tick.
    void repeat_step_at_end();
    /// From the next tick on.
    void let_go() noexcept { haptic_loop_.let_go(); }
    /// When the next tick is due, s.
    double next_tick_s() const noexcept { return haptic_ticks_.due_s(); }

    /// Stops the device, and passes the remaining data to their consumers.
    void end(const OnProgress& on_progress = {});

    /// After run() or end().
    MillingSessionReport report() const;
    /// Force of the scene's fixtures on the burr in the last tick, patient axes; on the virtual clock between
    /// two calls of advance().
    glm::dvec3 fixture_force_n() const { return coupling_->felt_fixtures().force_n; }
    /// Those of the scene's fixtures that can be on.
    FixtureSet held_fixtures() const { return held_fixtures_; }
    SolveCounts solve_counts() const { return coupling_->solve_counts(); }
    const std::array<std::uint64_t, HapticLoop::fault_kinds>& fault_counts() const {
        return haptic_loop_.fault_counts();
    }
    const Bone& bone() const { return model_->bone(); }
    /// By this session so far.
    RemovedByTissue removed_mm3() const { return model_->removed_mm3(); }
    double removed_mm3(std::size_t label) const { return model_->removed_mm3(label); }
    // For callers that step it, on the virtual clock between two calls of advance(): the newest results of
    // the haptic tick, and of the milling loop as that tick saw it.
    const ToolState& newest_state() {
        exchange_.status.refresh();
        return exchange_.status.front();
    }
    const MillingResult& known_result() const { return exchange_.results.front(); }

  private:
    /// The rights that the system gave a loop's thread, on the real clock.
    struct LoopThread {
        bool has_real_time_priority = false;
        std::uint64_t page_faults = 0;
    };
    HapticLoopParts haptic_parts() noexcept;
    MillingLoopParts milling_parts(const std::optional<Motor>& motor) noexcept;
    PeriodicLoop::Work haptic_work();
    PeriodicLoop::Work milling_work();
    void run_in_threads(const std::atomic<bool>& stop, const OnProgress& on_progress);
    void repeat_step(const StepTrace& step);
    void do_chores(const OnProgress& on_progress);
    void wait_for_room_in_queue(const std::atomic<bool>* stop, const OnProgress& on_progress);
    void send_what_overflowed();

    MillingSessionOptions options_;
    HapticDevice& device_;
    SampleLog<TickSample>* log_;
    SampleLog<MillingSample>* milling_log_;
    std::unique_ptr<ForceModel> model_;
    FixtureSet held_fixtures_;
    std::unique_ptr<Coupling> coupling_;
    SessionExchange exchange_;
    std::optional<HandpieceVibration> vibration_;
    HapticLoop haptic_loop_;
    std::vector<Burr> burrs_;
    TripleBuffer<BurrCommand> repeated_commands_;      // that the milling loop reads, with repeats_real_clock
    std::array<BurrCommand, 32> given_commands_{};     // by their tick's number
    std::optional<std::uint64_t> repeated_command_{};  // the last
    MillingLoop milling_loop_;
    PeriodicLoop haptic_ticks_;
    PeriodicLoop milling_steps_;
    double now_s_ = 0.0;       // the last haptic tick's
    std::uint64_t ticks_ = 0;  // on the virtual clock
    bool is_memory_locked_ = false;
    LoopThread haptic_thread_;
    LoopThread milling_thread_;
};

}  // namespace osteomill
