#include "slicer/slicer_port.h"

#include <gmock/gmock.h>
#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>

#include <array>
#include <boost/asio/read.hpp>
#include <optional>
#include <sstream>

namespace osteomill {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;
using namespace std::chrono_literals;
using ::testing::HasSubstr;

/// A port whose log the test reads, and those who connect to it.
class SlicerPortTest : public ::testing::Test {
  protected:
    SlicerPortTest() : before_(spdlog::default_logger()) {
        spdlog::set_default_logger(
            std::make_shared<spdlog::logger>("test", std::make_shared<spdlog::sinks::ostream_sink_mt>(log_)));
    }
    ~SlicerPortTest() override { spdlog::set_default_logger(before_); }

    tcp::socket connected() {
        tcp::socket socket(io_);
        socket.connect({asio::ip::address_v4::loopback(), port_.port()});
        port_.run_for(5ms);
        return socket;
    }
    /// Whether a message that is sent now arrives there.
    bool receives(tcp::socket& socket) {
        port_.send(status_message("BurrStatus", true, "the force is on"));
        port_.run_for(5ms);
        std::array<char, 58> header{};
        boost::system::error_code error;
        asio::read(socket, asio::buffer(header), error);
        while (!error && socket.available() > 0) socket.read_some(asio::buffer(header), error);
        return !error;
    }
    std::size_t log_lines() const {
        const std::string text = log_.str();
        return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
    }

    std::shared_ptr<spdlog::logger> before_;
    std::ostringstream log_;
    asio::io_context io_;
    int connections_ = 0;
    SlicerPort port_{0, {.connected = [this] { ++connections_; }, .said = [](auto&&...) {}}};
};

TEST_F(SlicerPortTest, IsTakenFromNobodyByOneWhoComesLater) {
    tcp::socket first = connected();
    ASSERT_TRUE(receives(first));
    for (int i = 0; i < 20; ++i) {
        tcp::socket later = connected();
        EXPECT_FALSE(receives(later)) << "it is closed";
        EXPECT_TRUE(receives(first));
    }
    EXPECT_EQ(connections_, 1);
    EXPECT_THAT(log_.str(),
                HasSubstr("a second connection to the port of 3D Slicer was refused: one is there"));
}

TEST_F(SlicerPortTest, IsFreeOnceWhoHadItHasLeft) {
    std::optional<tcp::socket> first = connected();
    ASSERT_TRUE(receives(*first));
    first.reset();
    while (port_.takes_more()) port_.run_for(1ms);
    tcp::socket second = connected();
    EXPECT_TRUE(receives(second));
    EXPECT_EQ(connections_, 2);
}

TEST_F(SlicerPortTest, FillsNoLogForThoseWhoComeAndGo) {
    for (int i = 0; i < 500; ++i) {
        tcp::socket visitor = connected();
        visitor.close();
        port_.run_for(1ms);
    }
    // Forty at once, then one every two seconds.
    EXPECT_LT(log_lines(), 40U + 60U);
}

}  // namespace
}  // namespace osteomill
