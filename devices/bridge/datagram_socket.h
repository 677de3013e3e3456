// A socket for datagrams, on a path of this machine or on a UDP port. Closed, and its path removed, by its
// destructor.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <variant>

#include "common/net/listen_address.h"
#include "devices/bridge/bridge_host.h"
#include "devices/wake_up.h"

namespace osteomill {

// Address at which the server meets an arm that lives in a process of its own.

/// A Unix socket, for a process on this machine.
struct BridgePath {
    std::filesystem::path path;
};

/// Either: a path, or a UDP port.
using BridgeAddress = std::variant<BridgePath, ListenAddress>;

/// Reads unix:PATH or udp:ADDRESS:PORT. Throws std::invalid_argument with one line that says what would be
/// right, also for a path that is too long for a socket.
BridgeAddress parse_bridge_address(const std::string& text);

/// The address as one types it.
std::string to_text(const BridgeAddress& where);

/// Whether only this machine can reach it.
bool is_local(const BridgeAddress& where);

class DatagramSocket {
  public:
    /// Throws std::runtime_error in one line that names the obstacle: an existing file, a missing folder. A
    /// socket left behind by a killed server is taken over, if this user owns it, only this user may write to
    /// it, as to ours, and nobody listens on it. Nothing else is ever removed, there or at the end.
    explicit DatagramSocket(const BridgeAddress& where);
    ~DatagramSocket();
    DatagramSocket(const DatagramSocket&) = delete;
    DatagramSocket& operator=(const DatagramSocket&) = delete;

    /// The port, if the system chose it.
    const BridgeAddress& address() const { return where_; }

    /// Waits for a datagram or for wake(), `longest_wait_ms` at most. Returns the datagram's length, or the
    /// buffer's if that is less; nullopt: none came.
    std::optional<std::size_t> receive(std::span<std::uint8_t> buffer, PeerAddress& from,
                                       int longest_wait_ms) noexcept;

    /// Ends a receive() of another thread, or the next. Real-time safe.
    void wake() noexcept { wake_.wake(); }

    /// Sends the datagram; if it cannot be sent now, it is lost.
    void send(std::span<const std::uint8_t> datagram, const PeerAddress& to) noexcept;

  private:
    BridgeAddress where_;
    int socket_ = -1;
    WakeUp wake_;
    // They identify our socket file: at the end the path may be another's.
    dev_t path_device_ = 0;
    ino_t path_inode_ = 0;
};

}  // namespace osteomill
