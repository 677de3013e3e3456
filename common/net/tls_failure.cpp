#include "common/net/tls_failure.h"

#include <fmt/format.h>
#include <openssl/err.h>
#include <openssl/x509.h>

#include <boost/asio/error.hpp>
#include <boost/asio/ssl/error.hpp>

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

}  // namespace osteomill
