// The thread that receives from a tracker: connects to its OpenIGTLink server as a client, reconnects when
// needed, and passes on samples and pedal as they arrive. It sends nothing.
#pragma once

#include <atomic>
#include <boost/lockfree/spsc_queue.hpp>
#include <cstdint>
#include <functional>
#include <string>
#include <thread>

#include "common/net/listen_address.h"
#include "devices/tracker/transform_stream.h"

namespace osteomill {

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

}  // namespace osteomill
