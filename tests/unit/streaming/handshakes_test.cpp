#include "haptic_server/streaming/handshakes.h"

#include <gmock/gmock.h>

#include <chrono>
#include <optional>
#include <vector>

#include "common/net/tls_context.h"
#include "tests/support/lab_certificates.h"

namespace osteomill {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;
using std::chrono::milliseconds;
using std::chrono::seconds;

class HandshakesTest : public ::testing::Test {
  protected:
    static constexpr milliseconds never = seconds(3600);

    static constexpr std::size_t places = 16;

    void begin_under_tls(milliseconds deadline) {
        if (!testing::has_openssl()) GTEST_SKIP() << testing::no_openssl;
        tls_.emplace(lab_.emplace().server("bench"), TlsContext::Role::server);
        handshakes_.emplace(io_, &*tls_, deadline, callbacks(), places);
    }
    Handshakes::Callbacks callbacks() {
        return {.on_done = [this](std::shared_ptr<Stream> stream) { done_.push_back(std::move(stream)); },
                .on_failed = [this](const std::string&, const std::string& why) { failed_.push_back(why); }};
    }
    /// Connects a client that says nothing.
    void connect_silent(const char* from = "127.0.0.1") {
        tcp::socket& client = clients_.emplace_back(io_, tcp::endpoint(asio::ip::make_address(from), 0));
        client.connect(acceptor_.local_endpoint());
        handshakes_->begin(acceptor_.accept());
    }
    /// Whether the server has hung up.
    bool is_dropped(tcp::socket& client) {
        client.non_blocking(true);
        char byte = 0;
        boost::system::error_code error;
        client.read_some(asio::buffer(&byte, 1), error);
        return error && error != asio::error::would_block;
    }

    asio::io_context io_{1};
    tcp::acceptor acceptor_{io_, {asio::ip::address_v4::loopback(), 0}};
    std::optional<testing::LabCertificates> lab_;
    std::optional<TlsContext> tls_;
    std::optional<Handshakes> handshakes_;
    std::vector<tcp::socket> clients_;
    std::vector<std::shared_ptr<Stream>> done_;
    std::vector<std::string> failed_;
};

TEST_F(HandshakesTest, AreOverAtOnceWithoutTls) {
    handshakes_.emplace(io_, nullptr, never, callbacks());
    connect_silent();
    EXPECT_EQ(done_.size(), 1U);
    io_.run_for(milliseconds(20));
    EXPECT_TRUE(failed_.empty());
    EXPECT_FALSE(is_dropped(clients_[0]));
}

TEST_F(HandshakesTest, EndAtTheirDeadline) {
    begin_under_tls(milliseconds(50));
    connect_silent();
    io_.run_for(seconds(30));
    EXPECT_THAT(failed_, ::testing::ElementsAre("no TLS handshake within 50 ms"));
    EXPECT_TRUE(is_dropped(clients_[0]));
    EXPECT_TRUE(done_.empty());
}

TEST_F(HandshakesTest, GiveWayToNewOnesWhenThereAreTooMany) {
    begin_under_tls(never);
    for (std::size_t i = 0; i < places + 2; ++i) connect_silent();
    EXPECT_EQ(failed_.size(), 2U);
    EXPECT_THAT(failed_[0], ::testing::HasSubstr("it gave way"));
    EXPECT_TRUE(is_dropped(clients_[0]));
    EXPECT_TRUE(is_dropped(clients_[1]));
    EXPECT_FALSE(is_dropped(clients_[2]));
}

TEST_F(HandshakesTest, AreNotCrowdedOutFromAnotherAddress) {
    begin_under_tls(never);
    connect_silent();
    for (std::size_t i = 0; i < 3 * places; ++i) connect_silent("127.0.0.2");
    EXPECT_EQ(failed_.size(), 2 * places + 1);
    EXPECT_FALSE(is_dropped(clients_[0]));
    EXPECT_TRUE(is_dropped(clients_[1]));
}

TEST_F(HandshakesTest, AreNotBegunWithOneWhoHangsUpWithoutAWord) {
    begin_under_tls(never);
    connect_silent();
    clients_[0].close();
    io_.run_for(seconds(30));
    EXPECT_THAT(failed_, ::testing::ElementsAre("it hung up"));
}

TEST_F(HandshakesTest, EndInSilenceWhenTheyAreCancelled) {
    begin_under_tls(never);
    connect_silent();
    handshakes_->cancel();
    io_.run_for(seconds(30));
    EXPECT_TRUE(failed_.empty());
    EXPECT_TRUE(is_dropped(clients_[0]));
}

}  // namespace
}  // namespace osteomill
