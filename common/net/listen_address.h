// Address at which a server listens, as typed on the command line.
#pragma once

#include <cstdint>
#include <string>

namespace osteomill {

struct ListenAddress {
    std::string address = "127.0.0.1";
    std::uint16_t port = 7010;  ///< 0: the system picks a free one
};

/// ADDRESS:PORT, with an IPv6 address in brackets, as it is read again.
inline std::string text_of_address(const std::string& address, std::uint16_t port) {
    const bool is_v6 = address.find(':') != std::string::npos;
    return (is_v6 ? '[' + address + ']' : address) + ':' + std::to_string(port);
}

/// HOST:PORT apart, where the last colon is; an IPv6 address without its brackets.
struct AddressParts {
    std::string host;
    std::string port;          ///< empty if there is no colon
    bool is_plain_v6 = false;  ///< colons in the host, and no brackets
};
AddressParts parts_of_address(const std::string& text);

/// Reads ADDRESS:PORT: a numeric address, with an IPv6 one in brackets, or "localhost". Throws
/// std::invalid_argument with one line that says what would be right.
ListenAddress parse_listen_address(const std::string& text);

/// The address of a server.
struct ServerAddress {
    std::string host = "127.0.0.1";
    std::uint16_t port = 7010;
};
/// Reads HOST:PORT, where the host is a name or a numeric address. Throws std::invalid_argument with one line
/// that says what would be right.
ServerAddress parse_server_address(const std::string& text);

/// The address as one types it.
std::string to_text(const ListenAddress& where);

/// Whether only this machine can reach it.
bool is_loopback(const ListenAddress& where);

}  // namespace osteomill
