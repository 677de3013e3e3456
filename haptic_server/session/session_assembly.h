// A session with all its parts, made in order: the scene with its bone, the device, logs, the milling
// session (its two loops: simulation/loop/milling_session.h), and its streaming. haptic_server, Python and
// tests each make one for a session; there may be many in a process.
//
// On the real clock it runs to its end; on the virtual one it can also be advanced tick by tick, and is the
// same to the bit however its ticks are divided.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>

#include "analysis/logs/csv_log.h"
#include "haptic_server/session/device_table.h"
#include "haptic_server/session/session_scene.h"
#include "haptic_server/session/shown_session.h"
#include "simulation/exchange/sample_log.h"
#include "simulation/loop/milling_session.h"

namespace osteomill {

/// The logs of a session's ticks and milling steps, as far as they are requested.
struct LogFiles {
    std::optional<std::filesystem::path> force{};    ///< a line a tick
    std::optional<std::filesystem::path> milling{};  ///< a line a milling step
};

class SessionLogs {
  public:
    /// Begins the files. Throws std::runtime_error in one line if one cannot be.
    SessionLogs(const LogFiles& files, bool has_shank);

    /// Null if none is requested.
    ForceLog* force() { return force_ ? &*force_ : nullptr; }
    MillingLog* milling() { return milling_ ? &*milling_ : nullptr; }

    /// Once nothing is written any more. Throws std::runtime_error in one line where lines are missing.
    void close_force();
    void close_milling();

  private:
    std::optional<ForceLog> force_;
    std::optional<MillingLog> milling_;
};

struct SessionOptions {
    /// The other parts decide whether it can be controlled, whether changes are consumed, and the volume
    /// removed before.
    MillingSessionOptions milling{};
    LogFiles logs{};
    SampleLog<TickSample>* more_ticks = nullptr;  ///< also gets every tick; outlives the session
    std::optional<ShownOptions> shown{};          ///< absent: no clients, no recording
};

/// The scene with its device placed on the patient, if it leaves that to the device. Placed once, it stays.
SessionScene seated(SessionScene scene, const DeviceParts& device);

class SessionAssembly {
  public:
    using OnProgress = MillingSession::OnProgress;

    /// Places the device on the patient, if the scene leaves that to it. `device` holds a device. Throws
    /// std::runtime_error or std::invalid_argument in one line if a part refuses its options, and for a
    /// session on the virtual clock that would never end, and if a file to write is one that the scene is
    /// made of.
    SessionAssembly(SessionScene scene, DeviceParts device, SessionOptions options);
    /// Another that goes on where `other` is, between two calls of its advance(), without logs, clients and
    /// recording. `device` holds a copy of its device. Throws std::invalid_argument for a session of the real
    /// clock.
    SessionAssembly(const SessionAssembly& other, DeviceParts device);
    SessionAssembly& operator=(const SessionAssembly&) = delete;

    /// The scene of the session: with its device placed.
    const Scene& scene() const { return scene_.scene; }
    const BoneSource& source() const { return scene_.source; }
    const MillingSessionOptions& options() const { return options_; }
    HapticDevice& device() { return *device_.device; }
    MillingSession& session() { return *session_; }
    const MillingSession& session() const { return *session_; }
    SessionLogs& logs() { return logs_; }
    /// Null: no clients, no recording.
    ShownSession* shown() { return shown_ ? &*shown_ : nullptr; }

    /// Waits for a client, if the options of streaming say so: the session's time begins then. Starts the
    /// device, runs until the duration has passed, `stop` is set, the simulated hand is at its trajectory's
    /// end or a client ends the session, and stops the device. Once. Throws as HapticDevice::start() does.
    void run(const std::atomic<bool>& stop, const OnProgress& on_progress = {});

    // Or, on the virtual clock, in this order and in steps.
    void start() { session_->start(); }
    /// Returns how many ticks were made: fewer than `ticks` if the session's duration is over.
    std::uint64_t advance(std::uint64_t ticks);
    void end();

    /// The completed share of a session on the virtual clock, 0 to 1.
    double done(double time_s) const;

  private:
    bool is_virtual() const { return options_.clock == ClockKind::virtual_time; }
    void show_frame();

    SessionScene scene_;
    DeviceParts device_;
    MillingSessionOptions options_;
    SessionLogs logs_;
    std::optional<SampleQueue<TickSample>> recorded_ticks_;
    SampleLogs<TickSample> tick_logs_;
    std::unique_ptr<MillingSession> session_;
    std::optional<ShownSession> shown_;
};

}  // namespace osteomill
