// One WebSocket connection to Haply's service. No call takes longer than the time it is given.
#pragma once

#include <chrono>
#include <cstddef>
#include <memory>
#include <optional>
#include <string_view>

#include "common/net/listen_address.h"

namespace osteomill {

class HaplyConnection {
  public:
    /// A state of a dozen devices with all of their configuration is a tenth of it.
    static constexpr std::size_t longest_message = 256 * 1024;

    HaplyConnection();
    /// Closes it without ado.
    ~HaplyConnection();
    HaplyConnection(const HaplyConnection&) = delete;
    HaplyConnection& operator=(const HaplyConnection&) = delete;

    /// Connects and shakes hands, once. False: no answer, or the other end speaks no WebSocket.
    bool open(const ListenAddress& service, std::chrono::milliseconds longest);

    /// False once the other end has gone, or broke the protocol of WebSocket, or sent too long a message.
    bool is_open() const;

    /// False: it is not open any more.
    bool send(std::string_view text, std::chrono::milliseconds longest);

    /// The next message, good until the next call; nullopt: none has come.
    std::optional<std::string_view> receive(std::chrono::milliseconds longest);

  private:
    struct Socket;
    std::unique_ptr<Socket> socket_;
};

}  // namespace osteomill
