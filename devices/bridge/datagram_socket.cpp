#include "devices/bridge/datagram_socket.h"

#include <fmt/format.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <boost/asio/ip/udp.hpp>
#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace osteomill {

namespace {

/// The arm's side makes a path of its own from it, a little longer.
constexpr std::size_t longest_path = sizeof(sockaddr_un::sun_path) - 33;

}  // namespace

BridgeAddress parse_bridge_address(const std::string& text) {
    if (text.starts_with("udp:")) return parse_listen_address(text.substr(4));
    if (!text.starts_with("unix:") || text.size() == 5)
        throw std::invalid_argument(
            fmt::format("'{}' is no address of a bridge; expected unix:PATH or udp:ADDRESS:PORT", text));
    const std::string path = text.substr(5);
    if (path.size() > longest_path)
        throw std::invalid_argument(
            fmt::format("'{}' is too long a path for a socket: {} characters at most", path, longest_path));
    return BridgePath{path};
}

std::string to_text(const BridgeAddress& where) {
    if (const auto* path = std::get_if<BridgePath>(&where)) return "unix:" + path->path.string();
    return "udp:" + to_text(std::get<ListenAddress>(where));
}

bool is_local(const BridgeAddress& where) {
    const auto* udp = std::get_if<ListenAddress>(&where);
    return udp == nullptr || is_loopback(*udp);
}

namespace {

[[noreturn]] void refuse(const BridgeAddress& where, const std::string& what) {
    throw std::runtime_error(fmt::format("{}: {}", to_text(where), what));
}

sockaddr_un address_of(const BridgePath& path) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    const std::string text = path.path.string();
    std::memcpy(address.sun_path, text.data(), std::min(text.size(), sizeof address.sun_path - 1));
    return address;
}

const sockaddr* generic(const sockaddr_un& address) {
    return reinterpret_cast<const sockaddr*>(&address);
}

/// The mode that bind() gives a path of ours.
constexpr mode_t own_mode = S_IFSOCK | S_IRWXU;

/// A socket of ours that nobody listens at any more is removed.
void clear_the_way(const BridgeAddress& where, const BridgePath& path) {
    struct stat found {};
    if (lstat(path.path.c_str(), &found) != 0) return;
    if (!S_ISSOCK(found.st_mode)) refuse(where, "is a file, and no socket; give another path");
    const int probe = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    const sockaddr_un address = address_of(path);
    const bool is_heard = probe >= 0 && connect(probe, generic(address), sizeof address) == 0;
    // A socket of another kind that is listened at answers with another error.
    const bool is_left = !is_heard && errno == ECONNREFUSED;
    if (probe >= 0) close(probe);
    if (is_left && found.st_uid == geteuid() && found.st_mode == own_mode) {
        unlink(path.path.c_str());
        return;
    }
    if (is_left) refuse(where, "is a socket that another program has left; remove it, or give another path");
    refuse(where, "another program listens there; give another path");
}

int open_path(const BridgeAddress& where, const BridgePath& path) {
    clear_the_way(where, path);
    const int opened = socket(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
    const sockaddr_un address = address_of(path);
    const mode_t before = umask(0077);
    const bool is_bound = opened >= 0 && bind(opened, generic(address), sizeof address) == 0;
    const int error = errno;
    umask(before);
    if (is_bound) return opened;
    if (opened >= 0) close(opened);
    refuse(where, fmt::format("no socket can be made there: {}", std::strerror(error)));
}

int open_udp(BridgeAddress& where) {
    auto& listen = std::get<ListenAddress>(where);
    const boost::asio::ip::udp::endpoint endpoint(boost::asio::ip::make_address(listen.address), listen.port);
    const int opened = socket(endpoint.data()->sa_family, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
    if (opened < 0 || bind(opened, endpoint.data(), static_cast<socklen_t>(endpoint.size())) != 0) {
        const int error = errno;
        if (opened >= 0) close(opened);
        refuse(where, fmt::format("cannot listen: {}", std::strerror(error)));
    }
    boost::asio::ip::udp::endpoint bound;
    auto size = static_cast<socklen_t>(bound.capacity());
    if (getsockname(opened, bound.data(), &size) == 0) listen.port = bound.port();
    return opened;
}

}  // namespace

DatagramSocket::DatagramSocket(const BridgeAddress& where) : where_(where) {
    const auto* path = std::get_if<BridgePath>(&where_);
    socket_ = path != nullptr ? open_path(where_, *path) : open_udp(where_);
    struct stat bound {};
    if (path != nullptr && lstat(path->path.c_str(), &bound) == 0) {
        path_device_ = bound.st_dev;
        path_inode_ = bound.st_ino;
    }
}

DatagramSocket::~DatagramSocket() {
    close(socket_);
    const auto* path = std::get_if<BridgePath>(&where_);
    struct stat found {};
    if (path != nullptr && lstat(path->path.c_str(), &found) == 0 && found.st_dev == path_device_ &&
        found.st_ino == path_inode_)
        unlink(path->path.c_str());
}

std::optional<std::size_t> DatagramSocket::receive(std::span<std::uint8_t> buffer, PeerAddress& from,
                                                   int longest_wait_ms) noexcept {
    sockaddr_storage sender{};
    iovec into{buffer.data(), buffer.size()};
    msghdr message{};
    message.msg_name = &sender;
    message.msg_namelen = sizeof sender;
    message.msg_iov = &into;
    message.msg_iovlen = 1;
    ssize_t bytes = recvmsg(socket_, &message, 0);
    if (bytes < 0 && (errno == EAGAIN || errno == EWOULDBLOCK) && longest_wait_ms > 0) {
        std::array<pollfd, 2> wait{pollfd{socket_, POLLIN, 0}, pollfd{wake_.descriptor(), POLLIN, 0}};
        if (poll(wait.data(), wait.size(), longest_wait_ms) > 0) {
            if (wait[1].revents != 0) wake_.wait(0);
            message.msg_namelen = sizeof sender;
            bytes = recvmsg(socket_, &message, 0);
        }
    }
    if (bytes < 0) return std::nullopt;
    const auto* begin = reinterpret_cast<const std::uint8_t*>(&sender);
    from.assign(begin, begin + std::min<std::size_t>(message.msg_namelen, sizeof sender));
    return static_cast<std::size_t>(bytes);
}

void DatagramSocket::send(std::span<const std::uint8_t> datagram, const PeerAddress& to) noexcept {
    if (to.empty()) return;  // a Unix socket without a name cannot be answered
    static_cast<void>(sendto(socket_, datagram.data(), datagram.size(), MSG_NOSIGNAL,
                             reinterpret_cast<const sockaddr*>(to.data()),
                             static_cast<socklen_t>(to.size())));
}

}  // namespace osteomill
