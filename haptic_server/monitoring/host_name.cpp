#include "haptic_server/monitoring/host_name.h"

#include <algorithm>
#include <boost/asio/ip/address.hpp>
#include <cctype>

#include "common/text/words.h"

namespace osteomill {

namespace {

constexpr std::string_view own_name = "localhost";

bool are_digits(std::string_view text) {
    return std::all_of(text.begin(), text.end(),
                       [](unsigned char letter) { return std::isdigit(letter) != 0; });
}

/// Without the port, the brackets of an IPv6 address and the dot of a name that is whole; empty if it is
/// malformed.
std::string name_of(std::string_view host) {
    if (host.starts_with('[')) {
        const std::size_t end = host.find(']');
        if (end == std::string_view::npos) return {};
        const std::string_view port = host.substr(end + 1);
        const bool is_whole = port.empty() || (port.front() == ':' && are_digits(port.substr(1)));
        return is_whole ? std::string(host.substr(1, end - 1)) : std::string();
    }
    const std::size_t colon = host.find(':');
    if (colon != std::string_view::npos && !are_digits(host.substr(colon + 1))) return {};
    std::string name = lower_case(std::string(host.substr(0, colon)));
    if (name.ends_with('.')) name.pop_back();
    return name;
}

}  // namespace

bool is_own_host(std::string_view host, std::span<const std::string> others) {
    if (host.empty()) return true;
    const std::string name = name_of(host);
    if (name.empty()) return false;
    boost::system::error_code is_no_address;
    boost::asio::ip::make_address(name, is_no_address);
    if (!is_no_address) return true;
    if (name == own_name || name.ends_with("." + std::string(own_name))) return true;
    return std::ranges::any_of(others, [&](const std::string& other) { return lower_case(other) == name; });
}

}  // namespace osteomill
