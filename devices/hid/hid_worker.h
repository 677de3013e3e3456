// A thread that talks to a HID device. A USB device may take a millisecond to accept a report, and many to
// open, so the haptic loop leaves both to this thread. It finds the device again after it was unplugged.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "devices/hid/hid_transport.h"

namespace osteomill {

/// The exchange on one connection, from plugging in to unplugging. Its destructor ends it. Implemented by
/// ArmConversation in hid_arm.cpp.
class HidConversation {
  public:
    virtual ~HidConversation() = default;

    /// One exchange, which waits for the device for some milliseconds at most. False: the device is gone, and
    /// its reader has been given it.
    virtual bool exchange() noexcept = 0;

    /// A notice for people, a text with static lifetime; empty while all is well.
    virtual const char* notice() const noexcept = 0;
};

struct HidWorkerParts {
    HidTransport& transport;  ///< outlives the worker
    /// Which of the devices is the one.
    std::function<bool(const HidDeviceInfo&)> is_wanted;
    /// For messages: "haptic arm (USB 1234:0006)".
    std::string what;
    std::function<std::unique_ptr<HidConversation>(std::unique_ptr<HidConnection>)> begin;
    /// Called on the thread before anything else, such as to ask for real-time priority.
    std::function<void()> on_thread_start = [] {};
};

class HidWorker {
  public:
    /// How often an unplugged device is looked for.
    static constexpr int look_again_ms = 300;

    explicit HidWorker(HidWorkerParts parts) : parts_(std::move(parts)) {}
    ~HidWorker() { stop(); }

    /// Opens the device and starts the thread. Throws std::runtime_error if there is none, HidOpenError
    /// if it cannot be opened.
    void start();

    /// Ends the conversation and the thread. Safe in any state.
    void stop() noexcept;

    /// Any thread.
    const char* notice() const noexcept { return notice_.load(std::memory_order_relaxed); }

  private:
    std::unique_ptr<HidConversation> open();
    void look_again();
    void run();

    HidWorkerParts parts_;
    std::unique_ptr<HidConversation> conversation_;  // the thread's own, while it runs
    std::atomic<const char*> notice_{""};
    std::atomic<bool> stops_{false};
    std::thread thread_;
};

}  // namespace osteomill
