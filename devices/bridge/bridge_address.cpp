#include "devices/bridge/bridge_address.h"

#include <fmt/format.h>
#include <sys/un.h>

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

}  // namespace osteomill
