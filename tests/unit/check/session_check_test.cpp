#include "haptic_server/check/session_check.h"

#include <gmock/gmock.h>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>

#include "tests/support/lab_certificates.h"

namespace osteomill {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

CheckRow row(const CheckedSession& session, const std::string& what) {
    for (const CheckRow& row : check_session(session))
        if (row.what == what) return row;
    ADD_FAILURE() << "no row says " << what;
    return {};
}

TEST(SessionCheck, FindsAPortThatIsTaken) {
    boost::asio::io_context context;
    boost::asio::ip::tcp::acceptor taken(context, {boost::asio::ip::make_address("127.0.0.1"), 0});
    const ListenAddress where{.port = taken.local_endpoint().port()};
    const CheckRow found = row({.listen = where}, "port");
    EXPECT_FALSE(found.is_right());
    EXPECT_THAT(found.found, HasSubstr("Address already in use"));
    EXPECT_THAT(found.mend, HasSubstr("ss -ltnp 'sport = :" + std::to_string(where.port)));
    taken.close();
    EXPECT_TRUE(row({.listen = where}, "port").is_right());
    EXPECT_FALSE(row({.listen = ListenAddress{.address = "192.0.2.1"}}, "port").is_right())
        << "an address that is not this machine's";
}

TEST(SessionCheck, FindsADiskThatIsNearlyFull) {
    CheckedSession session{
        .free_bytes = [](const std::filesystem::path&) { return std::uintmax_t{500'000'000}; }};
    const CheckRow found = row(session, "disk for recordings");
    EXPECT_THAT(found.found, HasSubstr("0.5 GB free in /"));
    EXPECT_THAT(found.cost, HasSubstr("a recording ends"));
    session.free_bytes = [](const std::filesystem::path&) { return std::uintmax_t{2'000'000'000}; };
    EXPECT_TRUE(row(session, "disk for recordings").is_right());
}

TEST(SessionCheck, FindsCertificatesThatEndOrHaveEnded) {
    if (!testing::has_openssl()) GTEST_SKIP() << "openssl is not installed";
    const testing::LabCertificates lab;
    const TlsFiles files = lab.server("server");
    EXPECT_TRUE(row({.tls = files}, "certificates").is_right());
    const auto in_ten_years = std::chrono::system_clock::now() + std::chrono::days(3650);
    EXPECT_THAT(row({.tls = files, .now = in_ten_years}, "certificates").cost,
                HasSubstr("within 30 days clients are refused"));
    const CheckRow expired = row({.tls = lab.expired_server()}, "certificates");
    EXPECT_THAT(expired.found, HasSubstr("expired"));
    EXPECT_THAT(expired.mend, HasSubstr("make_lab_certificates.sh"));
    TlsFiles missing = files;
    missing.key = "/nowhere.key";
    EXPECT_THAT(row({.tls = missing}, "certificates"),
                AllOf(::testing::Field(&CheckRow::found, HasSubstr("/nowhere.key")),
                      ::testing::Field(&CheckRow::cost, HasSubstr("ends at once"))));
}

}  // namespace
}  // namespace osteomill
