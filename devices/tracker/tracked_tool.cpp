#include "devices/tracker/tracked_tool.h"

#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <boost/asio/ip/tcp.hpp>
#include <cerrno>
#include <chrono>
#include <glm/geometric.hpp>
#include <utility>

namespace osteomill {

namespace {

constexpr int longest_poll_ms = 20;
constexpr int between_tries_ms = 200;
/// A connection that gives no sample for so long is made anew: its other end may be gone without notice.
constexpr double longest_silence_s = 3.0;
constexpr double sample_age_for_notice_s = 0.5;

int connected_socket(const ListenAddress& server) {
    const boost::asio::ip::tcp::endpoint endpoint(boost::asio::ip::make_address(server.address), server.port);
    const int opened = socket(endpoint.data()->sa_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
    if (opened < 0) return -1;
    if (connect(opened, endpoint.data(), static_cast<socklen_t>(endpoint.size())) == 0) return opened;
    if (errno == EINPROGRESS) {
        pollfd wait{opened, POLLOUT, 0};
        int error = 0;
        socklen_t size = sizeof error;
        if (poll(&wait, 1, between_tries_ms) > 0 &&
            getsockopt(opened, SOL_SOCKET, SO_ERROR, &error, &size) == 0 && error == 0)
            return opened;
    }
    close(opened);
    return -1;
}

}  // namespace

TrackerReceiver::TrackerReceiver(Parts parts)
    : parts_(std::move(parts)),
      stream_(
          parts_.name, parts_.pedal,
          {.sample =
               [this](const TrackerSample& sample) {
                   is_newer_ = is_newer_ || sample.stamp_s == 0.0 || sample.stamp_s > newest_stamp_s_;
                   newest_stamp_s_ = std::max(newest_stamp_s_, sample.stamp_s);
                   push({.sample = sample, .connection = connection_});
               },
           .pedal =
               [this](bool is_down) {
                   push(
                       {.is_pedal = true, .is_down = is_down, .said_s = empty_s_, .connection = connection_});
               }}) {}

void TrackerReceiver::start() {
    thread_ = std::thread([this] {
        parts_.on_thread_start();
        run();
    });
}

void TrackerReceiver::stop() noexcept {
    stops_.store(true);
    if (thread_.joinable()) thread_.join();
}

void TrackerReceiver::push(const Item& item) noexcept {
    // Full: the loop stands still, and will find the tool lost.
    static_cast<void>(items_.push(item));
}

void TrackerReceiver::run() {
    while (!stops_.load(std::memory_order_relaxed)) {
        const int socket = connected_socket(parts_.server);
        if (socket >= 0) {
            listen_to(socket);
            close(socket);
        } else {
            notice_.store("the tracker's server does not answer: is it running, and on this port?",
                          std::memory_order_relaxed);
        }
        for (int waited = 0; waited < between_tries_ms && !stops_.load(); waited += longest_poll_ms)
            std::this_thread::sleep_for(std::chrono::milliseconds(longest_poll_ms));
    }
}

void TrackerReceiver::listen_to(int socket) {
    stream_.restart();
    ++connection_;
    std::array<std::uint8_t, 65536> buffer;
    double heard_s = empty_s_ = parts_.now_s();
    double newer_s = heard_s;
    newest_stamp_s_ = 0.0;
    TransformStream::Counts before = stream_.counts();
    while (!stops_.load(std::memory_order_relaxed)) {
        const double looked_s = parts_.now_s();
        const ssize_t bytes = recv(socket, buffer.data(), buffer.size(), 0);
        const bool has_nothing_yet = errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR;
        if (bytes < 0 && has_nothing_yet) {
            if (errno != EINTR) empty_s_ = looked_s;
            pollfd wait{socket, POLLIN, 0};
            poll(&wait, 1, longest_poll_ms);
        }
        if (bytes == 0 || (bytes < 0 && !has_nothing_yet)) {
            notice_.store("the tracker's server has closed the connection", std::memory_order_relaxed);
            return;
        }
        if (bytes > 0 && !stream_.feed(std::span(buffer).first(static_cast<std::size_t>(bytes)))) {
            notice_.store("what comes from the tracker's port is no OpenIGTLink", std::memory_order_relaxed);
            return;
        }
        const double now_s = parts_.now_s();
        const TransformStream::Counts& now = stream_.counts();
        if (now.samples != before.samples) {
            heard_s = now_s;
            before = now;
            if (std::exchange(is_newer_, false)) newer_s = now_s;
            notice_.store(now_s - newer_s > sample_age_for_notice_s
                              ? "the tracker's time stamps stand still, or come in whole seconds"
                              : "",
                          std::memory_order_relaxed);
        } else if (now_s - heard_s > sample_age_for_notice_s) {
            notice_.store(now.damaged != before.damaged
                              ? "the tracker's TRANSFORMs are damaged, or no rigid motions"
                          : now.of_other_names != before.of_other_names
                              ? "the tracker sends TRANSFORMs, but of other names; see --tracker-name"
                          : now.hidden != before.hidden
                              ? "the tracker does not see the marker"
                              : "the tracker is connected and sends no TRANSFORM: is the marker seen?",
                          std::memory_order_relaxed);
            if (now_s - heard_s > longest_silence_s) return;
        }
    }
}

TrackedTool::TrackedTool(TrackerReceiver::Parts parts, TrackedHandpiece handpiece, const ToolPose& start_pose)
    : handpiece_(std::move(handpiece)), clock_s_(parts.now_s), receiver_([&] {
          parts.pedal = handpiece_.pedal;
          return std::move(parts);
      }()) {
    state_.position_mm = start_pose.position_mm;
    state_.spindle_axis = start_pose.spindle_axis;
}

void TrackedTool::take(const TrackerReceiver::Item& item, double now_s) noexcept {
    if (item.is_pedal) {
        pedal_ = {.is_down = item.is_down,
                  .said_s = said_at(now_s, clock_s_() - item.said_s),
                  .speaker = item.connection};
        return;
    }
    const TrackerSample& sample = item.sample;
    motion_.take({.stamp_s = sample.stamp_s,
                  .arrival_s = now_s,
                  .position_mm = sample.position_mm + sample.turn * handpiece_.burr_centre_mm,
                  .turn = sample.turn});
}

const char* TrackedTool::notice() const noexcept {
    const char* const of_the_link = receiver_.notice();
    if (*of_the_link != '\0') return of_the_link;
    switch (clock_fault_.load(std::memory_order_relaxed)) {
        case SampledMotion::ClockFault::none:
            return "";
        case SampledMotion::ClockFault::ahead:
            return "the tracker's clock runs faster than this machine's, or has jumped: the tool is not "
                   "followed";
        case SampledMotion::ClockFault::behind:
            return "the tracker's samples come later and later, or its clock runs slower than "
                   "this machine's: the tool is not followed";
    }
    return "";
}

DeviceState TrackedTool::read(double now_s) noexcept {
    TrackerReceiver::Item item;
    while (receiver_.pop(item)) take(item, now_s);
    const std::optional<SampledMotion::Pose> pose = motion_.at(now_s);
    clock_fault_.store(motion_.clock_fault(), std::memory_order_relaxed);
    state_.connected = pose.has_value();
    state_.velocity_mm_per_s = glm::dvec3(0.0);
    if (pose) {
        state_.position_mm = pose->position_mm;
        state_.velocity_mm_per_s = pose->velocity_mm_per_s;
        state_.spindle_axis = pose->turn * handpiece_.spindle_axis;
        if (!was_there_) came_back_s_ = now_s;
    }
    was_there_ = pose.has_value();
    if (handpiece_.pedal.empty()) {
        state_.pedal = {.is_down = now_s - came_back_s_ >= released_s, .said_s = now_s};
    } else {
        state_.pedal = pedal_;
        state_.pedal.acts_after_s = motion_.delay_s();
    }
    return state_;
}

}  // namespace osteomill
