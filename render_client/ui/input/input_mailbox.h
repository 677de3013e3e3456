// A mailbox for input events from the window's thread to the drawing thread: nothing is lost however seldom
// it is read, and neither thread waits for the other.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <utility>

#include "render_client/ui/input/window_input.h"

namespace osteomill {

class InputMailbox {
  public:
    using Time = std::chrono::steady_clock::time_point;

    void post(const WindowInput& input) {
        {
            const std::scoped_lock lock(mutex_);
            input_.append(input);
        }
        if (input.has_news) news_.notify_one();
    }

    /// The window as it is, and all that happened since the last call.
    WindowInput take() {
        const std::scoped_lock lock(mutex_);
        WindowInput taken = input_;
        input_.forget_events();
        return taken;
    }

    /// Returns when there is news, or at that time.
    void wait_until(Time time) {
        std::unique_lock lock(mutex_);
        news_.wait_until(lock, time, [this] { return input_.has_news; });
    }

  private:
    std::mutex mutex_;
    std::condition_variable news_;
    WindowInput input_;
};

}  // namespace osteomill
