// A handpiece seen by a tracker: the burr follows the hand, and no force goes back. Device space is the
// tracker's. The samples are played back by sampled_motion.h.
//
// A pedal sent as STRING messages is valid for Permission::by_message_s after each; so its sender repeats it.
// A press is delayed like the motion, or the burr would cut where the hand was before; a release acts at
// once. Without a pedal (one that is always down) visibility is the permission: the pedal counts as released
// for a moment when the tool reappears, since a spindle does not start by itself after a loss
// (safety/pedal_latch.h).
#pragma once

#include <atomic>
#include <boost/lockfree/spsc_queue.hpp>
#include <cstdint>
#include <functional>
#include <string>
#include <thread>

#include "common/net/listen_address.h"
#include "devices/tracker/sampled_motion.h"
#include "devices/tracker/tracker_file.h"
#include "devices/tracker/transform_stream.h"
#include "simulation/device/haptic_device.h"
#include "simulation/device/permission.h"

namespace osteomill {

/// The thread that receives from a tracker: connects to its OpenIGTLink server as a client, reconnects when
/// needed, and passes on samples and pedal as they arrive. It sends nothing.
class TrackerReceiver {
  public:
    struct Parts {
        ListenAddress server;           ///< where the tracker's server listens
        std::string name;               ///< whose TRANSFORMs; empty: the first that is seen
        std::string pedal;              ///< whose STRINGs; empty: nobody's
        std::function<double()> now_s;  ///< any clock; it measures silence and dates the pedal
        std::function<void()> on_thread_start = [] {};
    };

    explicit TrackerReceiver(Parts parts);
    ~TrackerReceiver() { stop(); }
    TrackerReceiver(const TrackerReceiver&) = delete;
    TrackerReceiver& operator=(const TrackerReceiver&) = delete;

    void start();
    void stop() noexcept;

    /// An arrived item: a sample, or a state of the pedal.
    struct Item {
        TrackerSample sample{};
        bool is_pedal = false;
        bool is_down = false;
        double said_s = 0.0;           ///< by the receiver's clock: the socket was last empty then
        std::uint64_t connection = 0;  ///< that it came by
    };
    /// The next one; one reader. Real-time safe.
    bool pop(Item& item) noexcept { return items_.pop(item); }

    /// A notice for people, in one line with static lifetime; empty while samples come. Any thread.
    const char* notice() const noexcept { return notice_.load(std::memory_order_relaxed); }

  private:
    void run();
    /// Until it ends, is no OpenIGTLink, or is silent for too long.
    void listen_to(int socket);
    void push(const Item& item) noexcept;

    Parts parts_;
    TransformStream stream_;
    double empty_s_ = 0.0;  // the socket held nothing then
    double newest_stamp_s_ = 0.0;
    bool is_newer_ = false;  // a sample came since it was last asked, and its stamp was newer
    std::uint64_t connection_ = 0;
    boost::lockfree::spsc_queue<Item, boost::lockfree::capacity<1024>> items_;
    std::atomic<const char*> notice_{"no tracker is connected yet"};
    std::atomic<bool> stops_{false};
    std::thread thread_;
};

class TrackedTool final : public HapticDevice {
  public:
    /// How long a pedal that is always down is up when the tool has come back.
    static constexpr double released_s = 0.1;

    /// `start_pose` in device space: where it is reported to be before it was ever seen.
    TrackedTool(TrackerReceiver::Parts parts, TrackedHandpiece handpiece, const ToolPose& start_pose);

    std::string name() const override { return "tracked handpiece"; }
    /// The force is computed and shown, as large as an arm would give it.
    DeviceLimits limits() const override { return {.gives_force = false}; }
    void start() override { receiver_.start(); }
    DeviceState read(double now_s) noexcept override;
    void write(const glm::dvec3&) noexcept override {}
    void stop() noexcept override { receiver_.stop(); }
    const char* notice() const noexcept override;

  private:
    void take(const TrackerReceiver::Item& item, double now_s) noexcept;

    TrackedHandpiece handpiece_;
    std::function<double()> clock_s_;
    TrackerReceiver receiver_;
    SampledMotion motion_;
    std::atomic<SampledMotion::ClockFault> clock_fault_{SampledMotion::ClockFault::none};
    PedalStatement pedal_;
    bool was_there_ = false;
    double came_back_s_ = 0.0;
    DeviceState state_;
};

}  // namespace osteomill
