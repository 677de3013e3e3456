#include "haptic_server/monitoring/metrics_server.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/write.hpp>
#include <memory>
#include <stdexcept>
#include <vector>

namespace osteomill {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class Visitor {
  public:
    explicit Visitor(std::uint16_t port) { socket_.connect({asio::ip::address_v4::loopback(), port}); }
    void say(const std::string& text) { asio::write(socket_, asio::buffer(text)); }
    /// All until the page hangs up.
    std::string hear() {
        std::string heard;
        boost::system::error_code end;
        asio::read(socket_, asio::dynamic_buffer(heard), end);
        return heard;
    }

  private:
    asio::io_context io_;
    tcp::socket socket_{io_};
};

std::string answer_to(const MetricsServer& page, const std::string& request_line) {
    Visitor visitor(page.port());
    visitor.say(request_line + " HTTP/1.1\r\nHost: localhost\r\n\r\n");
    return visitor.hear();
}

TEST(MetricsServer, GivesItsTextAtEachVisit) {
    int visits = 0;
    const MetricsServer page({.port = 0}, [&visits] { return "visit " + std::to_string(++visits) + "\n"; });
    for (const char* visit : {"visit 1\n", "visit 2\n"}) {
        const std::string answer = answer_to(page, "GET /metrics");
        EXPECT_THAT(answer, StartsWith("HTTP/1.1 200 OK\r\n"));
        EXPECT_THAT(answer, HasSubstr("Content-Type: text/plain; version=0.0.4"));
        EXPECT_TRUE(answer.ends_with("\r\n\r\n" + std::string(visit))) << answer;
    }
}

TEST(MetricsServer, HasNothingElseAndTakesNothing) {
    const MetricsServer page({.port = 0}, [] { return "text\n"; });
    EXPECT_THAT(answer_to(page, "GET /"), StartsWith("HTTP/1.1 404 "));
    EXPECT_THAT(answer_to(page, "GET /metrics/../etc"), StartsWith("HTTP/1.1 404 "));
    EXPECT_THAT(answer_to(page, "DELETE /metrics"), StartsWith("HTTP/1.1 405 "));
}

TEST(MetricsServer, TellsNothingUnderANameThatIsNotItsOwn) {
    bool was_asked = false;
    const MetricsServer page({.port = 0},
                             [&was_asked] {
                                 was_asked = true;
                                 return "text\n";
                             },
                             {"monitor.lab"});
    const auto asked_as = [&](const std::string& fields) {
        Visitor visitor(page.port());
        visitor.say("GET /metrics HTTP/1.1\r\n" + fields + "\r\n");
        return visitor.hear();
    };
    for (const char* fields : {"Host: evil.example:9464\r\n", "Host: localhost\r\nHost: evil.example\r\n",
                               "host: EVIL.example\x01\r\n"}) {
        const std::string answer = asked_as(fields);
        EXPECT_THAT(answer, ::testing::Not(HasSubstr("text\n"))) << fields;
        if (std::string(fields).find('\x01') == std::string::npos) {
            EXPECT_THAT(answer, StartsWith("HTTP/1.1 421 Misdirected Request\r\n"));
            EXPECT_THAT(answer, HasSubstr("this page is not of 'evil.example"));
            EXPECT_EQ(std::count(answer.begin(), answer.end(), '\n'),
                      std::count(answer.begin(), answer.end(), '\r') + 1)
                << "one line";
        }
    }
    EXPECT_FALSE(was_asked);
    for (const char* fields : {"Host: 127.0.0.1:9464\r\n", "Host: monitor.lab\r\n", ""})
        EXPECT_THAT(asked_as(fields), StartsWith("HTTP/1.1 200 OK\r\n")) << fields;
}

TEST(MetricsServer, OutlivesVisitorsThatSayNonsenseTooMuchOrNothing) {
    const MetricsServer page({.port = 0}, [] { return "text\n"; });
    Visitor(page.port()).say("\x16\x03\x01 nonsense\r\n\r\n");
    {
        Visitor talker(page.port());
        talker.say("GET /metrics HTTP/1.1\r\n" + std::string(7000, 'a'));
        talker.say(std::string(5000, 'a'));
        EXPECT_EQ(talker.hear(), "");
    }
    const Visitor silent(page.port());
    { const Visitor gone(page.port()); }
    EXPECT_THAT(answer_to(page, "GET /metrics"), HasSubstr("text\n"));
}

TEST(MetricsServer, IsKeptFromNobodyByVisitorsThatAskForHalfOfIt) {
    const MetricsServer page({.port = 0}, [] { return "text\n"; });
    // More than it bears at a time: were each waited for, a minute and a half.
    std::vector<std::unique_ptr<Visitor>> visitors;
    for (int i = 0; i < 40; ++i) {
        visitors.push_back(std::make_unique<Visitor>(page.port()));
        visitors.back()->say("G");
    }
    EXPECT_THAT(answer_to(page, "GET /metrics"), HasSubstr("text\n"));
    EXPECT_EQ(visitors.front()->hear(), "");
}

TEST(MetricsServer, SaysWhereItCannotBe) {
    const MetricsServer page({.port = 0}, [] { return std::string(); });
    try {
        const MetricsServer other({.port = page.port()}, [] { return std::string(); });
        FAIL() << "two pages at one address";
    } catch (const std::runtime_error& error) {
        EXPECT_EQ(error.what(),
                  "--metrics 127.0.0.1:" + std::to_string(page.port()) + ": Address already in use");
    }
}

}  // namespace
}  // namespace osteomill
