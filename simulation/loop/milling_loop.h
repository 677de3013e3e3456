// One step of the milling loop: the newest command in, the model's step, result and changes out.
//
// The haptic loop sends a command every tick. Up to its rate, each step goes all the way to the newest
// command. At a higher rate (the time-resolved force needs 10 kHz) the steps of a tick divide the path to it,
// and the haptic loop gets their mean once a tick: it could not render more.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/scene/burr.h"
#include "simulation/exchange/change_queue.h"
#include "simulation/exchange/milling_step.h"
#include "simulation/exchange/sample_log.h"
#include "simulation/exchange/session_gate.h"
#include "simulation/exchange/triple_buffer.h"
#include "simulation/force_models/force_model.h"
#include "simulation/loop/clearance.h"
#include "simulation/loop/cut_report.h"

namespace osteomill {

/// The milling force at the rate of the milling loop as CSV, one line a step: with --force-model
/// milling-instants at 10 kHz, the force within the tooth period.
///
/// Columns: t_s; burr_*_mm, patient LPS; force_*_n, of the bone on the burr during the step, patient axes;
/// removed_mm3 by the step; spindle 0 or 1.
struct MillingSample {
    double time_s = 0.0;
    glm::dvec3 burr_mm{0.0};
    glm::dvec3 force_n{0.0};
    double removed_mm3 = 0.0;
    bool spindle_on = false;

    static std::string header_line();
    /// 1.6 s of steps at 10 kHz.
    static constexpr std::size_t capacity = 16384;
    void append_to(fmt::memory_buffer& text) const;
};

struct MillingLoopParts {
    ForceModel& model;
    TripleBuffer<BurrCommand>& commands;      ///< read
    TripleBuffer<MillingResult>& results;     ///< written
    ChangeQueue& changes;                     ///< written
    SampleLog<MillingSample>* log = nullptr;  ///< written; null: no log
    std::span<const Burr> burrs{};            ///< the scene's set: burrs that may be put in the burr's place
    ChangeQueue* restored = nullptr;          ///< read: bone to be given back by undo; null: none ever is
    SessionGate* gate = nullptr;              ///< written, with `restored`
    TripleBuffer<std::optional<CutState>>* cuts = nullptr;  ///< written; null: no sound
    std::optional<Motor> motor{};                           ///< the scene's, for `cuts`
};

class MillingLoop {
  public:
    /// All parts outlive the loop. Commands come every `command_period_s`. Allocates.
    MillingLoop(const MillingLoopParts& parts, double command_period_s);
    /// Goes on where `other` is, with other parts. Between steps.
    MillingLoop(const MillingLoop& other, const MillingLoopParts& parts);
    MillingLoop& operator=(const MillingLoop&) = delete;

    /// The step that ends at session time `time_s` and lasted `elapsed_s` since the last. Before the first
    /// command there is nothing to do. `missed`: so many periods were skipped before it. Real-time safe.
    void step(double time_s, double elapsed_s, std::uint64_t missed = 0) noexcept;
    /// By all steps so far, less bone given back.
    double total_removed_mm3() const { return total_removed_mm3_; }
    /// Bricks that were given back.
    std::uint64_t restored_changes() const { return restored_changes_; }

    /// A tool so fast that it needs a larger margin is not examined: that would take too long.
    static constexpr double most_room_mm = 2.0;
    /// Bricks that are restored in a millisecond: a stroke of a hundred bricks is back within a frame of the
    /// picture, and they take a tenth of a step's time.
    static constexpr double restored_bricks_per_ms = 4.0;

  private:
    MillingLoop(const MillingLoop&) = default;
    /// The pose that the burr shall have at the end of this step.
    ToolPose pose_on_the_way(double elapsed_s) noexcept;
    /// With the spindle off, applies as much of the queue of restored bone as a step has time for.
    void restore(double elapsed_s) noexcept;
    /// MillingResult::room_for_change_mm. Looks beyond both burrs and their shanks by a voxel, and by twice
    /// the tool's motion since the last result: when this one is read it will have moved on.
    double room_for_change_mm(const BurrCommand& command) const noexcept;
    void note_step(std::uint64_t command, std::uint64_t missed) noexcept;
    void report_cut(const MillingResult& result, double speed_share) noexcept;

    MillingLoopParts parts_;
    double command_period_s_;
    std::vector<std::vector<HullBall>> hulls_{};  // by burr
    CutReport cut_;
    bool has_command_ = false;
    ToolPose start_;                      // where the burr was when the newest command came
    ToolPose pose_;                       // where it is
    double underway_s_ = 0.0;             // since then
    glm::dvec3 published_mm_{0.0};        // where the burr was when the last result was published
    std::uint64_t restored_changes_ = 0;  // since the start

    // Since the last result was published.
    double elapsed_s_ = 0.0;
    glm::dvec3 impulse_n_s_{0.0};
    double removed_mm3_ = 0.0;
    double total_removed_mm3_ = 0.0;  // since the start
    std::array<StepRun, newest_step_runs> newest_runs_{};
    std::uint64_t idle_periods_ = 0;  // before the first command
    bool touches_protected_ = false;
};

}  // namespace osteomill
