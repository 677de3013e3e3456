// A server's metrics page, asked for as Prometheus does.
#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/write.hpp>
#include <map>
#include <sstream>
#include <string>

namespace osteomill::testing {

/// The values of the page on `port` of loopback, by name with labels. Throws if nobody listens.
inline std::map<std::string, double> scraped(const std::string& port) {
    boost::asio::io_context io;
    boost::asio::ip::tcp::socket socket(io);
    socket.connect({boost::asio::ip::address_v4::loopback(), static_cast<std::uint16_t>(std::stoi(port))});
    boost::asio::write(socket,
                       boost::asio::buffer(std::string("GET /metrics HTTP/1.1\r\nHost: localhost\r\n\r\n")));
    std::string answer;
    boost::system::error_code end;
    boost::asio::read(socket, boost::asio::dynamic_buffer(answer), end);
    std::map<std::string, double> values;
    std::istringstream lines(answer.substr(answer.find("\r\n\r\n") + 4));
    for (std::string line; std::getline(lines, line);)
        if (!line.starts_with("#"))
            values[line.substr(0, line.rfind(' '))] = std::stod(line.substr(line.rfind(' ')));
    return values;
}

}  // namespace osteomill::testing
