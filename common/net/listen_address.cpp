#include "common/net/listen_address.h"

#include <fmt/format.h>

#include <boost/asio/ip/address.hpp>
#include <charconv>
#include <stdexcept>

namespace osteomill {

ListenAddress parse_listen_address(const std::string& text) {
    const std::size_t colon = text.rfind(':');
    if (colon == std::string::npos) {
        throw std::invalid_argument(fmt::format("'{}' has no port; expected ADDRESS:PORT", text));
    }
    ListenAddress result;
    result.address = text.substr(0, colon);
    if (result.address == "localhost") result.address = "127.0.0.1";
    if (result.address.size() > 2 && result.address.front() == '[' && result.address.back() == ']') {
        result.address = result.address.substr(1, result.address.size() - 2);
    } else if (result.address.find(':') != std::string::npos) {
        throw std::invalid_argument(
            fmt::format("'{}': an IPv6 address needs brackets, [ADDRESS]:PORT", text));
    }
    boost::system::error_code error;
    boost::asio::ip::make_address(result.address, error);
    if (error) {
        throw std::invalid_argument(fmt::format(
            "'{}' is not a numeric address; expected for example 127.0.0.1:7010", result.address));
    }
    const char* const end = text.data() + text.size();
    const auto [parsed, failure] = std::from_chars(text.data() + colon + 1, end, result.port);
    if (failure != std::errc{} || parsed != end) {
        throw std::invalid_argument(
            fmt::format("'{}' is not a port; expected 0 to 65535", text.substr(colon + 1)));
    }
    return result;
}

std::string to_text(const ListenAddress& where) {
    const bool is_v6 = where.address.find(':') != std::string::npos;
    return fmt::format(fmt::runtime(is_v6 ? "[{}]:{}" : "{}:{}"), where.address, where.port);
}

bool is_loopback(const ListenAddress& where) {
    return boost::asio::ip::make_address(where.address).is_loopback();
}

}  // namespace osteomill
