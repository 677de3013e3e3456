// Two ends of a connection on loopback that shake hands, or find out why they will not.
#include <gmock/gmock.h>

#include <boost/asio/buffer.hpp>
#include <boost/asio/error.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ssl/stream.hpp>
#include <boost/asio/write.hpp>
#include <optional>

#include "common/net/stream.h"
#include "common/net/tls_context.h"
#include "tests/support/lab_certificates.h"
#include "tests/support/messages.h"

namespace osteomill {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;
using boost::system::error_code;
using ::testing::HasSubstr;
using testing::LabCertificates;
using Role = TlsContext::Role;

class TlsStreamTest : public ::testing::Test {
  protected:
    void SetUp() override {
        if (!testing::has_openssl()) GTEST_SKIP() << testing::no_openssl;
        lab_.emplace();
    }

    /// Runs until `is_so`, or up to a deadline: in the product a deadline elsewhere finds such faults.
    void run_until(const std::function<bool()>& is_so) {
        io_.restart();
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
        while (!is_so() && std::chrono::steady_clock::now() < end)
            io_.run_one_for(std::chrono::milliseconds(100));
        EXPECT_TRUE(is_so());
    }

    void connect() {
        tcp::acceptor acceptor(io_, {asio::ip::address_v4::loopback(), 0});
        client_socket_.connect(acceptor.local_endpoint());
        server_socket_ = acceptor.accept();
    }

    std::shared_ptr<Stream> serve(const TlsFiles& files) {
        server_tls_.emplace(files, Role::server);
        auto stream = serving_stream(std::move(server_socket_), &*server_tls_, 4096);
        stream->handshake([this, stream](const std::string& failure) {
            server_failure_ = failure;
            if (!failure.empty()) stream->close();
        });
        return stream;
    }

    /// Reads, too: with TLS 1.3 a client is done before the server has seen its certificate.
    std::shared_ptr<Stream> join(const TlsFiles& files, const std::string& host = "127.0.0.1") {
        client_tls_.emplace(files, Role::client);
        auto stream = connecting_stream(std::move(client_socket_), &*client_tls_, host, 4096);
        stream->handshake([this, stream](const std::string& failure) {
            client_failure_ = failure;
            client_refused_ = stream->is_refused();
            if (!failure.empty()) return stream->close();
            stream->read([this](error_code error, std::span<const std::uint8_t> arrived) {
                client_error_ = error;
                client_arrived_.assign(arrived.begin(), arrived.end());
            });
        });
        return stream;
    }

    /// Both, until both know.
    void meet(const TlsFiles& server, const TlsFiles& client, const std::string& host = "127.0.0.1") {
        connect();
        const auto serving = serve(server);
        const auto joining = join(client, host);
        run_until([this] {
            return server_failure_ && client_failure_ && (!client_failure_->empty() || client_error_);
        });
    }

    /// A client made by hand, which lacks something.
    void meet_by_hand(asio::ssl::context& context) {
        connect();
        const auto serving = serve(lab_->server("bench"));
        asio::ssl::stream<tcp::socket> client(std::move(client_socket_), context);
        client.async_handshake(asio::ssl::stream_base::client, [](error_code) {});
        run_until([this] { return server_failure_.has_value(); });
        client.next_layer().close();
        run_until([this] { return io_.poll() == 0; });
    }

    /// A client that does not look at its own certificate.
    void meet_by_hand_with(const TlsFiles& files) {
        asio::ssl::context context(asio::ssl::context::tls_client);
        context.use_certificate_chain_file(files.certificate.string());
        context.use_private_key_file(files.key.string(), asio::ssl::context::pem);
        meet_by_hand(context);
    }

    std::optional<LabCertificates> lab_;
    std::optional<TlsContext> server_tls_;
    std::optional<TlsContext> client_tls_;
    asio::io_context io_{1};
    tcp::socket server_socket_{io_};
    tcp::socket client_socket_{io_};
    std::optional<std::string> server_failure_;
    std::optional<std::string> client_failure_;
    bool client_refused_ = false;
    std::optional<error_code> client_error_;
    std::string client_arrived_;
};

TEST_F(TlsStreamTest, CarriesBytesBothWaysBetweenTwoOfALab) {
    connect();
    const auto server = serve(lab_->server("bench"));
    const auto client = join(lab_->client("viewer"));
    run_until([this] { return server_failure_ && client_failure_; });
    EXPECT_EQ(*server_failure_, "");
    EXPECT_EQ(*client_failure_, "");
    EXPECT_THAT(server->peer(), ::testing::MatchesRegex("127.0.0.1:[0-9]+ \\(viewer\\)"));
    EXPECT_THAT(client->peer(), HasSubstr("(bench)"));

    std::string server_arrived;
    server->read([&](error_code error, std::span<const std::uint8_t> arrived) {
        EXPECT_FALSE(error) << error.message();
        server_arrived.assign(arrived.begin(), arrived.end());
    });
    client->write("to the server", [](error_code error) { EXPECT_FALSE(error); });
    server->write("to the client", [](error_code error) { EXPECT_FALSE(error); });
    run_until([&] { return !server_arrived.empty() && !client_arrived_.empty(); });
    EXPECT_EQ(server_arrived, "to the server");
    EXPECT_EQ(client_arrived_, "to the client");

    std::optional<error_code> end;
    server->read([&](error_code error, std::span<const std::uint8_t>) { end = error; });
    client->close();
    run_until([&] { return end.has_value(); });
    EXPECT_EQ(*end, asio::error::eof);
}

TEST_F(TlsStreamTest, RefusesAClientOfAnotherLabAndTellsIt) {
    const LabCertificates other;
    meet(lab_->server("bench"), lab_->impostor(other.client("stranger")));
    EXPECT_THAT(*server_failure_, HasSubstr(testing::certificate_refused));
    ASSERT_TRUE(client_error_);
    EXPECT_TRUE(is_refusal(*client_error_));
    EXPECT_THAT(describe_stream_error(*client_error_), HasSubstr("it refuses this program"));
}

TEST_F(TlsStreamTest, RefusesAClientWhoseCertificateHasExpired) {
    meet_by_hand_with(lab_->expired_client());
    EXPECT_EQ(*server_failure_, testing::certificate_refused + ": certificate has expired");
}

TEST_F(TlsStreamTest, RefusesAServersCertificateFromAClient) {
    meet_by_hand_with(lab_->server("other"));
    EXPECT_THAT(*server_failure_, HasSubstr("purpose"));
}

TEST_F(TlsStreamTest, RefusesAClientWhoseCertificateNamesNoUsage) {
    meet_by_hand_with(lab_->client_without_usage());
    EXPECT_THAT(*server_failure_, HasSubstr("purpose"));
}

TEST_F(TlsStreamTest, RefusesARevokedClientAndTellsItThatItIsFinal) {
    const TlsFiles lost = lab_->client("lost");
    TlsFiles bench = lab_->server("bench");
    bench.crl = lab_->revoke("lost");
    meet(bench, lost);
    EXPECT_EQ(*server_failure_, testing::certificate_refused + ": certificate revoked");
    EXPECT_THAT(describe_stream_error(*client_error_), HasSubstr("certificate revoked"));
    EXPECT_TRUE(is_about_certificates(*client_error_));
}

TEST_F(TlsStreamTest, KnowsTheWholeSubjectOfTheOtherEndAndWhetherItHasBeenRevokedSince) {
    TlsFiles bench = lab_->server("bench");
    bench.crl = lab_->revoke();
    connect();
    const auto server = serve(bench);
    EXPECT_EQ(server->subject(), "");
    const auto client = join(lab_->client("viewer"));
    run_until([this] { return server_failure_ && client_failure_; });
    EXPECT_EQ(server->subject(), "CN=viewer");
    EXPECT_EQ(client->subject(), "CN=bench");
    EXPECT_FALSE(server->is_revoked());
    lab_->revoke("viewer");
    const auto later = std::chrono::steady_clock::now() + std::chrono::hours(1);
    EXPECT_TRUE(server_tls_->refresh(later).has_news);
    EXPECT_TRUE(server->is_revoked());
    EXPECT_FALSE(client->is_revoked()) << "it knows no list";
}

TEST_F(TlsStreamTest, RefusesAClientWithoutCertificate) {
    asio::ssl::context context(asio::ssl::context::tls_client);
    meet_by_hand(context);
    EXPECT_EQ(*server_failure_, "it shows no certificate");
}

TEST_F(TlsStreamTest, RefusesTls12) {
    const TlsFiles files = lab_->client("viewer");
    asio::ssl::context context(asio::ssl::context::tlsv12_client);
    context.use_certificate_chain_file(files.certificate.string());
    context.use_private_key_file(files.key.string(), asio::ssl::context::pem);
    meet_by_hand(context);
    EXPECT_EQ(*server_failure_, "it does not speak TLS 1.3");
}

TEST_F(TlsStreamTest, IsNotMadeByAClientWithAServerOfAnotherLab) {
    const LabCertificates other;
    meet(other.impostor(other.server("bench")), lab_->client("viewer"));
    EXPECT_THAT(*client_failure_, HasSubstr(testing::certificate_refused));
    EXPECT_THAT(*server_failure_, HasSubstr("it refuses this program"));
    EXPECT_TRUE(client_refused_);
}

TEST_F(TlsStreamTest, IsNotMadeByAClientWithAnotherHostThanItAskedFor) {
    meet(lab_->server("bench", "192.0.2.7 bench.example"), lab_->client("viewer"));
    EXPECT_EQ(*client_failure_, testing::certificate_refused + ": IP address mismatch");
}

TEST_F(TlsStreamTest, IsNotMadeByAClientWithAnotherNameThanItAskedFor) {
    meet(lab_->server("bench", "127.0.0.1 bench.example"), lab_->client("viewer"), "localhost");
    EXPECT_EQ(*client_failure_, testing::certificate_refused + ": hostname mismatch");
}

TEST_F(TlsStreamTest, KnowsTheHostByItsNameToo) {
    connect();
    const auto server = serve(lab_->server("bench", "bench.example"));
    const auto client = join(lab_->client("viewer"), "bench.example");
    run_until([this] { return server_failure_ && client_failure_; });
    EXPECT_EQ(*server_failure_ + *client_failure_, "");
}

TEST_F(TlsStreamTest, SaysThatAClientDoesNotSpeakTls) {
    connect();
    const auto server = serve(lab_->server("bench"));
    asio::write(client_socket_, asio::buffer(std::string("GET / HTTP/1.1\r\n\r\n")));
    run_until([this] { return server_failure_.has_value(); });
    EXPECT_EQ(*server_failure_, "it does not speak TLS");
}

TEST_F(TlsStreamTest, SaysThatAServerDoesNotSpeakTls) {
    connect();
    asio::write(server_socket_, asio::buffer(std::string(100, '\x1c')));
    const auto client = join(lab_->client("viewer"));
    run_until([this] { return client_failure_.has_value(); });
    EXPECT_EQ(*client_failure_, "it does not speak TLS");
    EXPECT_FALSE(client_refused_) << "it may be restarted with TLS";
}

}  // namespace
}  // namespace osteomill
