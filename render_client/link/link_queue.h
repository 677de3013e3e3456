// The events that the receiving thread hands to the UI thread, in the order in which it came, and their
// bounded queue.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <variant>

#include "common/wire/session_receiver.h"
#include "render_client/link/session_source.h"

namespace osteomill {

/// A server sent its hello: events of an earlier one no longer count.
struct SessionBegan {
    SessionInfo info;
    std::uint64_t number = 0;  ///< counted from 1
};

/// The link stands otherwise than before.
struct StatusChanged {
    LinkStatus status = LinkStatus::connecting;
    std::string line{};
};

using LinkEvent =
    std::variant<SessionBegan, BoneArrived, StateArrived, CtPieceArrived, StructureArrived, StatusChanged>;

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
