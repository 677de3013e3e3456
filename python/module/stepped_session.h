// A session on the virtual clock that is stepped from outside, a millisecond a tick: by a hand at prescribed
// poses, or by the simulated arm in a hand that follows the scene's trajectory. A thin layer over
// SessionAssembly: it sets the hand, keeps that motion, and records the values of each tick. The tick of time
// 0, with the hand at the start and the pedal up, is made at once.
//
// A saved session is the motion of its hand: the session is a pure function of that. Loading plays the motion
// again from the bone as it was loaded, which takes as long as the session took to compute, and needs no
// second bone.
#pragma once

#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "devices/simulated/prescribed_device.h"
#include "haptic_server/session/session_assembly.h"
#include "python/module/loaded_case.h"

namespace osteomill::python {

struct SteppedOptions {
    std::optional<Grip> grip{};  ///< of the simulated hand; nothing: the hand is at prescribed poses
    std::optional<CouplingChoice> coupling{};  ///< nothing: the usual one
    std::string force_model = force_model_names().front();
    std::optional<double> milling_rate_hz{};  ///< nothing: the usual one
    bool vibration = false;
    std::optional<ToolPose> start{};  ///< in place of the scene's
    std::optional<ArmModel> arm{};    ///< nothing: the simulated one, or at prescribed poses the ideal one
    std::optional<std::filesystem::path> record{};
};

/// The hand from one tick on, for so many. Patient LPS; the axis is a unit vector from tip to shank.
struct HandInput {
    ToolPose pose{};
    bool pedal = false;
    std::int32_t burr = -1;  ///< number in the scene's set that is requested; -1: none
    std::uint64_t ticks = 1;

    bool is_as(const HandInput& other) const {
        return pose == other.pose && pedal == other.pedal && burr == other.burr;
    }
};

/// Values of a tick.
struct TickState {
    ToolState tool{};
    glm::dvec3 milling_force_n{
        0.0};  ///< of the bone on the burr, mean over the newest milling step known to the tick
    std::vector<double> removed_mm3{};  ///< so far, by LoadedCase::labels()
    double removed_in_all_mm3 = 0.0;
    glm::dvec3 fixture_force_n{0.0};   ///< of the scene's fixtures on the burr
    double spindle_torque_n_mm = 0.0;  ///< that the cut takes (spindle_torque.h), in the tick's ms
    double spindle_power_w = 0.0;
};

/// Motion of a session's hand since it began.
struct FedMotion {
    std::string session;  ///< case and settings: only a session of the same accepts the motion
    std::vector<HandInput> inputs{};
};

class SteppedSession {
  public:
    /// Throws std::invalid_argument or std::runtime_error in one line for anything that a part refuses.
    SteppedSession(std::shared_ptr<const LoadedCase> loaded, SteppedOptions options);
    ~SteppedSession();
    /// Goes on where `other` is, to the bit; it is not recorded. The caller holds other's `busy`. Throws
    /// std::logic_error if `other` has ended.
    SteppedSession(const SteppedSession& other);
    SteppedSession& operator=(const SteppedSession&) = delete;

    // One thread at a time: the caller of these holds `busy`.
    /// Throws std::runtime_error in a process that was forked from the session's: the session's memory is
    /// there, and none of its threads.
    std::mutex& busy() {
        if (!is_of_this_process())
            throw std::runtime_error(
                "the session is of the process that this one was forked from; make another");
        return busy_;
    }
    bool is_of_this_process() const { return ::getpid() == process_; }

    /// Makes the ticks of `input`. Throws std::logic_error once the session has ended.
    void step(const HandInput& input);
    /// State after the last tick.
    TickState state() const;
    const ToolState& tool() const { return run_.tool; }
    const glm::dvec3& milling_force_n() const { return run_.assembly->session().known_result().force_n; }
    /// Torque that the cut takes, in the last tick's ms; 0 while the spindle stands.
    double spindle_torque_n_mm() const;
    /// Volume removed so far, of one tissue, and of all that the bone had.
    double removed_mm3(std::size_t label) const { return run_.assembly->session().removed_mm3(label); }
    double removed_in_all_mm3() const;

    /// The hand that was prescribed last, or where the session starts.
    const ToolPose& hand() const { return run_.hand; }
    bool has_simulated_hand() const { return options_.grip.has_value(); }
    /// The simulated hand is at its trajectory's end.
    bool is_finished() const { return run_.simulated != nullptr && run_.simulated->is_finished(); }
    bool has_ended() const { return has_ended_; }
    bool is_recorded() const { return options_.record.has_value(); }

    const LoadedCase& loaded() const { return *loaded_; }
    std::shared_ptr<const LoadedCase> shared_case() const { return loaded_; }
    const Bone& bone() const { return run_.assembly->session().bone(); }
    /// Limit of the arm.
    double max_force_n() const;
    const MillingSessionOptions& settings() const { return run_.assembly->options(); }

    FedMotion fed() const { return {.session = origin_, .inputs = run_.fed}; }
    /// Goes to the end of the motion. `pace` is called with a function that computes the next second or less
    /// of it, and calls that; if `pace` throws, the session stays as it was. Throws std::invalid_argument for
    /// a motion of another case or other settings, and for a session that is recorded.
    using Pace = std::function<void(const std::function<void()>& compute)>;
    void replay(const FedMotion& motion, const Pace& pace);

    /// Ends the session; a recording is whole then. Throws std::runtime_error if it could not be written.
    void end();

  private:
    void begin();
    void make_ticks(const HandInput& input);

    std::shared_ptr<const LoadedCase> loaded_;
    SteppedOptions options_;
    std::string origin_;
    std::mutex busy_;
    pid_t process_ = ::getpid();
    struct Run {
        PrescribedDevice* prescribed = nullptr;      // the assembly's
        const SimulatedDevice* simulated = nullptr;  // likewise
        std::unique_ptr<SessionAssembly> assembly{};
        ToolState tool{};
        glm::dvec3 burr_before_mm{0.0};  // a tick before `tool`
        ToolPose hand{};
        std::vector<HandInput> fed{};
    };
    Run run_;
    bool has_ended_ = false;
};

}  // namespace osteomill::python
