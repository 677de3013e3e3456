// Address at which the server meets an arm that lives in a process of its own.
#pragma once

#include <filesystem>
#include <string>
#include <variant>

#include "common/net/listen_address.h"

namespace osteomill {

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

}  // namespace osteomill
