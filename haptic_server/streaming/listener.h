// The socket on which a streaming server waits for clients.
#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>

#include "haptic_server/streaming/streaming_options.h"

namespace osteomill {

/// Bound and listening. Throws std::runtime_error, in one line, if the address is none, cannot be had, or
/// would serve other machines in the clear without being asked to.
boost::asio::ip::tcp::acceptor listen(boost::asio::io_context& io, const StreamingOptions& options);

}  // namespace osteomill
