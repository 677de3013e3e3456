#include "common/net/stream.h"

#include <fmt/format.h>
#include <openssl/bio.h>
#include <openssl/err.h>
#include <openssl/ssl.h>
#include <openssl/x509.h>
#include <openssl/x509v3.h>

#include <algorithm>
#include <array>
#include <boost/asio/buffer.hpp>
#include <boost/asio/error.hpp>
#include <boost/asio/ip/address.hpp>
#include <boost/asio/ssl/error.hpp>
#include <boost/asio/ssl/stream.hpp>
#include <boost/asio/write.hpp>
#include <cctype>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

#include "common/net/tls_context.h"

namespace osteomill {

namespace {

bool is_of_openssl(const boost::system::error_code& error) {
    return error.category() == boost::asio::error::get_ssl_category();
}

int reason_of(const boost::system::error_code& error) {
    return ERR_GET_REASON(static_cast<unsigned long>(error.value()));
}

std::string describe_openssl(const boost::system::error_code& error) {
    const int reason = reason_of(error);
    switch (reason) {
        case SSL_R_PEER_DID_NOT_RETURN_A_CERTIFICATE:
            return "it shows no certificate";
        case SSL_R_UNSUPPORTED_PROTOCOL:
        case SSL_R_TLSV1_ALERT_PROTOCOL_VERSION:
            return "it does not speak TLS 1.3";
        case SSL_R_WRONG_VERSION_NUMBER:
        case SSL_R_HTTP_REQUEST:
        case SSL_R_HTTPS_PROXY_REQUEST:
        case SSL_R_PACKET_LENGTH_TOO_LONG:
        case SSL_R_BAD_RECORD_TYPE:
            return "it does not speak TLS";
        default:
            break;
    }
    if (is_refusal(error))
        return fmt::format("it refuses this program: {}",
                           SSL_alert_desc_string_long(reason - SSL_AD_REASON_OFFSET));
    const char* text = ERR_reason_error_string(static_cast<unsigned long>(error.value()));
    return text != nullptr ? text : error.message();
}

}  // namespace

bool is_refusal(const boost::system::error_code& error) {
    return is_of_openssl(error) && reason_of(error) >= SSL_AD_REASON_OFFSET &&
           reason_of(error) < SSL_AD_REASON_OFFSET + 256;
}

bool is_about_certificates(const boost::system::error_code& error) {
    if (!is_of_openssl(error)) return false;
    if (reason_of(error) == SSL_R_CERTIFICATE_VERIFY_FAILED) return true;
    if (!is_refusal(error)) return false;
    switch (reason_of(error) - SSL_AD_REASON_OFFSET) {
        case SSL_AD_BAD_CERTIFICATE:
        case SSL_AD_UNSUPPORTED_CERTIFICATE:
        case SSL_AD_CERTIFICATE_REVOKED:
        case SSL_AD_CERTIFICATE_EXPIRED:
        case SSL_AD_CERTIFICATE_UNKNOWN:
        case SSL_AD_UNKNOWN_CA:
        case SSL_AD_ACCESS_DENIED:
        case SSL_AD_CERTIFICATE_REQUIRED:
            return true;
        default:
            return false;
    }
}

std::string describe_stream_error(const boost::system::error_code& error) {
    if (is_of_openssl(error)) return describe_openssl(error);
    if (error == boost::asio::error::eof || error == boost::asio::ssl::error::stream_truncated)
        return "it hung up";
    return error.message();
}

std::string describe_handshake_failure(const SSL* tls, const boost::system::error_code& error) {
    const long verified = SSL_get_verify_result(tls);
    const bool is_refused = is_of_openssl(error) && reason_of(error) == SSL_R_CERTIFICATE_VERIFY_FAILED;
    if (is_refused && verified == X509_V_ERR_CRL_HAS_EXPIRED)
        return "its certificate is not accepted: the list of revoked certificates (--tls-crl) has expired";
    if (is_refused && verified == X509_V_ERR_UNABLE_TO_GET_CRL)
        return "its certificate is not accepted: there is no list of revoked certificates (--tls-crl) of its "
               "CA";
    if (is_refused)
        return fmt::format("its certificate is not accepted: {}", X509_verify_cert_error_string(verified));
    return describe_stream_error(error);
}

namespace asio = boost::asio;
namespace ssl = boost::asio::ssl;
using asio::ip::tcp;
using boost::system::error_code;

namespace {

/// Reading and writing, which TCP and TLS have in common.
template <typename Transport>
class StreamOver : public Stream, public std::enable_shared_from_this<StreamOver<Transport>> {
  public:
    template <typename... Arguments>
    StreamOver(tcp::socket socket, std::size_t read_bytes, Arguments&&... arguments)
        : peer_(describe_end(socket)),
          arrived_(read_bytes),
          transport_(std::move(socket), std::forward<Arguments>(arguments)...) {}

    void read(ReadHandler handler) override {
        transport_.async_read_some(
            asio::buffer(arrived_), [self = this->shared_from_this(), handler = std::move(handler)](
                                        error_code error, std::size_t bytes) {
                // A peer that hangs up seldom closes TLS first, and the length of a frame shows whether it
                // is whole.
                if (error == ssl::error::stream_truncated) error = asio::error::eof;
                handler(error, std::span<const std::uint8_t>(self->arrived_).first(bytes));
            });
    }

    void write(std::string bytes, WriteHandler handler) override {
        under_way_ = std::move(bytes);
        asio::async_write(transport_, asio::buffer(under_way_),
                          [self = this->shared_from_this(), handler = std::move(handler)](
                              error_code error, std::size_t) { handler(error); });
    }

    void wait_until_taken(std::function<void()> handler) override {
        this->socket().async_wait(
            asio::socket_base::wait_write,
            [self = this->shared_from_this(), handler = std::move(handler)](error_code) { handler(); });
    }

  protected:
    std::string peer_;
    std::vector<std::uint8_t> arrived_;
    std::string under_way_;
    Transport transport_;
};

class PlainStream final : public StreamOver<tcp::socket> {
  public:
    using StreamOver::StreamOver;
    void handshake(HandshakeHandler handler) override { handler(""); }
    std::string peer() override { return peer_; }
    tcp::socket& socket() override { return transport_; }
};

class TlsStream final : public StreamOver<ssl::stream<tcp::socket>> {
  public:
    TlsStream(tcp::socket socket, TlsContext& tls, std::size_t read_bytes)
        : StreamOver(std::move(socket), read_bytes, tls.context()),
          tls_(tls),
          role_(tls.role() == TlsContext::Role::server ? ssl::stream_base::server
                                                       : ssl::stream_base::client) {}

    /// The other end's certificate is to be for this name or address.
    void require_host(const std::string& host) {
        SSL* const native = transport_.native_handle();
        error_code not_numeric;
        asio::ip::make_address(host, not_numeric);
        X509_VERIFY_PARAM* const wanted = SSL_get0_param(native);
        X509_VERIFY_PARAM_set_hostflags(wanted, X509_CHECK_FLAG_NEVER_CHECK_SUBJECT);
        const bool is_set = not_numeric
                                ? X509_VERIFY_PARAM_set1_host(wanted, host.c_str(), host.size()) == 1 &&
                                      SSL_set_tlsext_host_name(native, host.c_str()) == 1
                                : X509_VERIFY_PARAM_set1_ip_asc(wanted, host.c_str()) == 1;
        if (!is_set) throw std::runtime_error("no certificate can be for the host " + host);
    }

    void handshake(HandshakeHandler handler) override {
        transport_.async_handshake(
            role_, [this, self = shared_from_this(), handler = std::move(handler)](error_code error) {
                is_refused_ = error && is_about_certificates(error);
                handler(error ? describe_handshake_failure(transport_.native_handle(), error) : "");
            });
    }

    std::string peer() override {
        const X509* const certificate = checked_certificate();
        if (certificate == nullptr) return peer_;
        std::array<char, 65> name{};  // X.520's longest common name
        X509_NAME_get_text_by_NID(X509_get_subject_name(certificate), NID_commonName, name.data(),
                                  static_cast<int>(name.size()));
        // It goes into logs, and the lab may have signed it without reading it.
        std::string text = name.data();
        std::replace_if(
            text.begin(), text.end(), [](unsigned char c) { return std::iscntrl(c) != 0; }, '?');
        return peer_ + " (" + text + ")";
    }

    std::string subject() override {
        const X509* const certificate = checked_certificate();
        const std::unique_ptr<BIO, decltype(&BIO_free)> text(BIO_new(BIO_s_mem()), &BIO_free);
        if (certificate == nullptr || !text) return {};
        X509_NAME_print_ex(text.get(), X509_get_subject_name(certificate), 0, XN_FLAG_RFC2253);
        char* data = nullptr;
        const long length = BIO_get_mem_data(text.get(), &data);
        return length > 0 ? std::string(data, static_cast<std::size_t>(length)) : std::string();
    }

    bool is_revoked() override {
        X509* const certificate = checked_certificate();
        return certificate != nullptr && tls_.revokes(*certificate);
    }

    bool is_refused() const override { return is_refused_; }

    tcp::socket& socket() override { return transport_.next_layer(); }

  private:
    /// The other end's, once it has been accepted; null before.
    X509* checked_certificate() {
        SSL* const native = transport_.native_handle();
        return SSL_get_verify_result(native) == X509_V_OK ? SSL_get0_peer_certificate(native) : nullptr;
    }

    TlsContext& tls_;
    bool is_refused_ = false;
    ssl::stream_base::handshake_type role_;
};

}  // namespace

std::string describe_end(const tcp::socket& socket) {
    error_code error;
    const auto endpoint = socket.remote_endpoint(error);
    if (error) return "a client";
    std::ostringstream text;
    text << endpoint;
    return text.str();
}

void Stream::end_writing() {
    error_code ignored;
    socket().shutdown(tcp::socket::shutdown_send, ignored);
}

void Stream::close() {
    error_code ignored;
    socket().close(ignored);
}

std::shared_ptr<Stream> serving_stream(tcp::socket socket, TlsContext* tls, std::size_t read_bytes) {
    if (tls == nullptr) return std::make_shared<PlainStream>(std::move(socket), read_bytes);
    return std::make_shared<TlsStream>(std::move(socket), *tls, read_bytes);
}

std::shared_ptr<Stream> connecting_stream(tcp::socket socket, TlsContext* tls, const std::string& host,
                                          std::size_t read_bytes) {
    if (tls == nullptr) return std::make_shared<PlainStream>(std::move(socket), read_bytes);
    auto stream = std::make_shared<TlsStream>(std::move(socket), *tls, read_bytes);
    stream->require_host(host);
    return stream;
}

}  // namespace osteomill
