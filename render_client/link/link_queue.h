// The bounded queue of events from the receiving thread to the UI thread.
#pragma once

#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>

#include "render_client/link/link_event.h"

namespace osteomill {

/// A queue that is full is not an error: the receiving thread stops reading until there is space, and the
/// server sends later what it could not send now. Status changes always fit: one that follows another
/// replaces it.
class LinkQueue {
  public:
    /// About two seconds of state frames; at 128 KiB each, 8 MiB.
    static constexpr std::size_t capacity = 64;

    /// Receiving thread. A new session empties the queue first.
    void push(LinkEvent event) {
        const std::scoped_lock lock(mutex_);
        if (is_disowned_) return;
        if (std::holds_alternative<SessionBegan>(event)) events_.clear();
        if (std::holds_alternative<StatusChanged>(event) && !events_.empty() &&
            std::holds_alternative<StatusChanged>(events_.back()))
            events_.back() = std::move(event);
        else
            events_.push_back(std::move(event));
    }

    /// Receiving thread. Whether to stop reading for now.
    bool is_full() const {
        const std::scoped_lock lock(mutex_);
        return events_.size() >= capacity;
    }

    /// UI thread.
    std::optional<LinkEvent> pop() {
        const std::scoped_lock lock(mutex_);
        if (events_.empty()) return std::nullopt;
        LinkEvent event = std::move(events_.front());
        events_.pop_front();
        return event;
    }

    /// UI thread. Drops the events in the queue, and later ones of this connection, until own().
    void disown() {
        const std::scoped_lock lock(mutex_);
        events_.clear();
        is_disowned_ = true;
    }
    /// Receiving thread. Events from now on count again.
    void own() {
        const std::scoped_lock lock(mutex_);
        is_disowned_ = false;
    }

  private:
    mutable std::mutex mutex_;
    std::deque<LinkEvent> events_;
    bool is_disowned_ = false;
};

}  // namespace osteomill
