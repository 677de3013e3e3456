// The receiving side of the link: connects, reads, decodes, and tries again, on a thread of its own.
#pragma once

#include <atomic>
#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <utility>
#include <variant>

#include "common/net/stream.h"
#include "common/net/tls_context.h"
#include "common/recording/recording_writer.h"
#include "common/wire/frame.h"
#include "common/wire/session_receiver.h"
#include "render_client/link/client_outbox.h"
#include "render_client/link/session_source.h"

namespace osteomill {

// The events that the receiving thread hands to the UI thread, in the order in which it came, and their
// bounded queue.

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

/// Counters that the receiving thread keeps and any thread may read.
struct LinkCounters {
    std::atomic<std::uint64_t> bytes{0};
    std::atomic<std::uint64_t> connections{0};
    std::atomic<std::uint64_t> rejected_frames{0};
    std::atomic<std::uint32_t> snapshot_bricks{0};
    std::atomic<std::uint32_t> snapshot_bricks_total{0};
    std::atomic<std::chrono::steady_clock::duration> heard{};  ///< the last time, since the clock's epoch
};

class ServerConnection {
  public:
    /// Also writes received frames into `record`, if that is given, and speaks TLS if `tls` is. Throws
    /// RecordingError if a recording cannot begin, std::runtime_error if the files of TLS are no good.
    ServerConnection(std::string host, std::uint16_t port,
                     const std::optional<std::filesystem::path>& record = std::nullopt,
                     const std::optional<TlsFiles>& tls = std::nullopt);
    ~ServerConnection();
    ServerConnection(const ServerConnection&) = delete;
    ServerConnection& operator=(const ServerConnection&) = delete;

    LinkQueue& events() { return events_; }
    const LinkCounters& counters() const { return counters_; }

    // Any thread.
    /// Sends the command as the answer to newest_tool(). Dropped while no state has come, and if the server
    /// would not accept it.
    void send(const OperatorCommand& command);
    /// Dropped if the server would not accept it, and beyond ClientOutbox::most_waiting_controls that wait to
    /// be written.
    void send(const SessionControl& control);
    /// The operator's viewpoint, sent again on later connections; only to servers that record it.
    void send(const Viewpoint& view);
    /// Asks for the CT; dropped if the server has none.
    void ask_for_ct();
    /// The tool of the newest state frame on this connection; nothing before the first.
    std::optional<ToolState> newest_tool() const;
    /// Dropped if that session is over.
    void send(const v2::CompareBone& request, std::uint64_t session_number);
    /// Frees it on the receiving thread: a large bone takes a tenth of a second.
    void discard(std::shared_ptr<void> unused);
    /// The queue has space again.
    void resume();
    /// Why nothing more is recorded; empty while all is well, and if nothing is to be.
    std::string recording_error() const;
    /// Writes the frames that still wait; later ones are not recorded. Returns one line if some could not be
    /// written.
    std::string finish_recording();
    /// Drops the data of this connection and begins another.
    void reconnect();
    /// To another server from now on.
    void connect_to(std::string host, std::uint16_t port);
    /// Joins no session until told otherwise; one that was joined goes on, and its end is told.
    void leave_alone(bool leaves_alone);

  private:
    using tcp = boost::asio::ip::tcp;

    /// A recording has none: changes of a frame that is missing there cannot be requested years later.
    Gaps gaps() const { return recorder_ ? Gaps::refused : Gaps::reported; }

    void run();
    void connect();
    void shake_hands();
    void disconnect();
    void watch_silence();
    void read();
    void read_when_recorded();
    void take_frames();
    std::optional<WireError> take(std::span<const std::uint8_t> message);
    void take_event(SnapshotGoesOn);
    void take_event(SessionInfo session);
    void take_event(BoneArrived arrived);
    void take_event(StateArrived arrived);
    void take_event(CtPieceArrived arrived) { events_.push(std::move(arrived)); }
    void take_event(StructureArrived arrived) { events_.push(std::move(arrived)); }
    void see(const StateArrived& arrived);
    void forget_seen();
    void take_event(const SaidGoodbye& goodbye);
    void take_event(const SpeaksOtherProtocol& other);
    void write_newest();
    void reject(const std::string& line);
    void lose(const std::string& line);
    /// This program cannot mend it, so it tries again at leisure.
    void refuse(std::string line);
    std::string describe_loss(boost::system::error_code error) const;
    void retry_later();
    bool is_in_session() const {
        return stream_ != nullptr &&
               (announced_ == LinkStatus::receiving_snapshot || announced_ == LinkStatus::live);
    }
    void announce(LinkStatus status, std::string line);

    std::string host_;
    std::uint16_t port_;
    std::string where_;
    LinkQueue events_;
    LinkCounters counters_;
    std::unique_ptr<TlsContext> tls_;  // null: in the clear
    std::optional<RecordingWriter> recorder_;

    boost::asio::io_context io_{1};
    // While reading is paused nothing else keeps the thread there.
    boost::asio::executor_work_guard<boost::asio::io_context::executor_type> work_{io_.get_executor()};
    tcp::resolver resolver_{io_};
    tcp::socket socket_{io_};
    boost::asio::steady_timer retry_{io_};
    boost::asio::steady_timer silence_{io_};
    boost::asio::steady_timer recorder_room_{io_};
    std::chrono::milliseconds backoff_{0};
    bool leaves_alone_ = false;

    // The current connection's; `generation_` tells its handlers from those of earlier ones.
    std::uint64_t generation_ = 0;
    std::shared_ptr<Stream> stream_;  // null while there is none
    bool has_heard_ = false;
    FrameDecoder decoder_;
    SessionReceiver receiver_;
    bool is_paused_ = false;

    // The state that the operator's input answers: the newest, though it may not be drawn yet.
    mutable std::mutex seen_mutex_;
    std::uint64_t seen_generation_ = 0;
    std::uint64_t seen_state_ = 0;  // 0: none
    std::optional<ToolState> seen_tool_;

    ClientOutbox outbox_;
    bool is_writing_ = false;

    LinkStatus announced_ = LinkStatus::connecting;
    std::thread thread_;
};

}  // namespace osteomill
