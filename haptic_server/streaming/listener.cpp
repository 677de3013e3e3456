#include "haptic_server/streaming/listener.h"

#include <spdlog/spdlog.h>

#include <boost/asio/ip/address.hpp>
#include <stdexcept>
#include <string>

namespace osteomill {

namespace asio = boost::asio;
using asio::ip::tcp;
using boost::system::error_code;

tcp::acceptor listen(asio::io_context& io, const StreamingOptions& options) {
    const std::string where = options.address + ":" + std::to_string(options.port);
    error_code error;
    const asio::ip::address address = asio::ip::make_address(options.address, error);
    if (error)
        throw std::runtime_error("cannot listen on " + where + ": \"" + options.address +
                                 "\" is no IP address; 127.0.0.1 or ::1 would be");
    if (!address.is_loopback() && !options.tls && !options.insecure_network)
        throw std::runtime_error("cannot listen on " + where +
                                 ": without TLS only this machine is served; use 127.0.0.1 or ::1");
    if (!address.is_loopback() && !options.tls)
        spdlog::warn("{} is served without TLS: anybody who reaches it sees everything and may drill", where);
    tcp::acceptor acceptor(io);
    const tcp::endpoint endpoint(address, options.port);
    acceptor.open(endpoint.protocol(), error);
    if (!error) acceptor.set_option(tcp::acceptor::reuse_address(true), error);
    if (!error) acceptor.bind(endpoint, error);
    if (!error) acceptor.listen(asio::socket_base::max_listen_connections, error);
    if (error) throw std::runtime_error("cannot listen on " + where + ": " + error.message());
    return acceptor;
}

}  // namespace osteomill
