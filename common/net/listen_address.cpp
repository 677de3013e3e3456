#include "common/net/listen_address.h"

#include <fmt/format.h>

#include <boost/asio/ip/address.hpp>
#include <stdexcept>

#include "common/text/words.h"

namespace osteomill {

AddressParts parts_of_address(const std::string& text) {
    const std::size_t colon = text.rfind(':');
    AddressParts parts{.host = text.substr(0, colon), .port = {}};
    if (colon != std::string::npos) parts.port = text.substr(colon + 1);
    std::string& host = parts.host;
    if (host.size() > 2 && host.front() == '[' && host.back() == ']')
        host = host.substr(1, host.size() - 2);
    else
        parts.is_plain_v6 = host.find(':') != std::string::npos;
    return parts;
}

ListenAddress parse_listen_address(const std::string& text) {
    if (text.find(':') == std::string::npos)
        throw std::invalid_argument(fmt::format("'{}' has no port; expected ADDRESS:PORT", text));
    const AddressParts parts = parts_of_address(text);
    if (parts.is_plain_v6)
        throw std::invalid_argument(
            fmt::format("'{}': an IPv6 address needs brackets, [ADDRESS]:PORT", text));
    ListenAddress result{.address = parts.host == "localhost" ? "127.0.0.1" : parts.host};
    boost::system::error_code error;
    boost::asio::ip::make_address(result.address, error);
    if (error)
        throw std::invalid_argument(fmt::format(
            "'{}' is not a numeric address; expected for example 127.0.0.1:7010", result.address));
    const auto port = parse_number<std::uint16_t>(parts.port);
    if (!port)
        throw std::invalid_argument(fmt::format("'{}' is not a port; expected 0 to 65535", parts.port));
    result.port = *port;
    return result;
}

ServerAddress parse_server_address(const std::string& text) {
    const AddressParts parts = parts_of_address(text);
    const auto port = parse_number<std::uint16_t>(parts.port);
    if (parts.host.empty() || port.value_or(0) == 0)
        throw std::invalid_argument(
            fmt::format("is '{}', not HOST:PORT with a port from 1 to 65535, such as 127.0.0.1:7010", text));
    return {parts.host, static_cast<std::uint16_t>(*port)};
}

std::string to_text(const ListenAddress& where) {
    const bool is_v6 = where.address.find(':') != std::string::npos;
    return fmt::format(fmt::runtime(is_v6 ? "[{}]:{}" : "{}:{}"), where.address, where.port);
}

bool is_loopback(const ListenAddress& where) {
    return boost::asio::ip::make_address(where.address).is_loopback();
}

}  // namespace osteomill
