#include "haptic_server/check/session_check.h"

#include <fmt/format.h>
#include <openssl/pem.h>
#include <openssl/x509.h>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <cstdio>
#include <memory>

#include "common/net/tls_context.h"

namespace osteomill {

namespace {

/// An hour of the tooth takes some tens of megabytes, of a large head drilled all over ten times that.
constexpr double least_free_gb = 1.0;
constexpr int soon_days = 30;

CheckRow port_row(const ListenAddress& listen) {
    using boost::asio::ip::tcp;
    const std::string where = fmt::format("{}:{}", listen.address, listen.port);
    boost::asio::io_context context;
    boost::system::error_code error;
    const tcp::endpoint endpoint(boost::asio::ip::make_address(listen.address, error), listen.port);
    tcp::acceptor acceptor(context);
    if (!error) acceptor.open(endpoint.protocol(), error);
    if (!error) acceptor.set_option(tcp::acceptor::reuse_address(true), error);
    if (!error) acceptor.bind(endpoint, error);
    if (!error) acceptor.listen(1, error);
    if (!error) return {"port", where + " is free"};
    return {"port", fmt::format("{}: {}", where, error.message()), "the server ends at once",
            fmt::format("sudo ss -ltnp 'sport = :{}' shows who listens there; or --listen {}:0, any free one",
                        listen.port, listen.address)};
}

std::unique_ptr<X509, decltype(&X509_free)> certificate_in(const std::filesystem::path& file) {
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> in(std::fopen(file.c_str(), "r"), &std::fclose);
    return {in ? PEM_read_X509(in.get(), nullptr, nullptr, nullptr) : nullptr, &X509_free};
}

CheckRow tls_row(const TlsFiles& files, std::chrono::system_clock::time_point now) {
    const char* const mend = "scripts/make_lab_certificates.sh makes new ones; see docs/network.md";
    try {
        const TlsContext context(files, TlsContext::Role::server);
    } catch (const std::exception& error) {
        return {"certificates", error.what(), "the server ends at once", mend};
    }
    const auto certificate = certificate_in(files.certificate);
    const ASN1_TIME* const ends = X509_get0_notAfter(certificate.get());
    CheckRow row{"certificates",
                 fmt::format("{} holds until {}", files.certificate.string(), text_of(*ends))};
    std::time_t soon = std::chrono::system_clock::to_time_t(now + std::chrono::days(soon_days));
    if (X509_cmp_time(ends, &soon) > 0) return row;
    row.cost = fmt::format("within {} days clients are refused", soon_days);
    row.mend = mend;
    return row;
}

CheckRow disk_row(const CheckedSession& session) {
    constexpr double gb = 1e9;
    const double free_gb = static_cast<double>(session.free_bytes(session.records_in)) / gb;
    CheckRow row{"disk for recordings", fmt::format("{:.1f} GB free in {}", free_gb,
                                                    std::filesystem::absolute(session.records_in).string())};
    if (free_gb >= least_free_gb) return row;
    row.cost = "a recording ends where the disk is full; the session goes on without";
    row.mend = fmt::format(
        "free some, or --record into another folder; du -xh '{}' | sort -h | tail shows what "
        "is large",
        session.records_in.string());
    return row;
}

}  // namespace

std::vector<CheckRow> check_session(const CheckedSession& session) {
    std::vector<CheckRow> rows;
    if (session.listen) rows.push_back(port_row(*session.listen));
    if (session.tls) rows.push_back(tls_row(*session.tls, session.now));
    rows.push_back(disk_row(session));
    return rows;
}

}  // namespace osteomill
