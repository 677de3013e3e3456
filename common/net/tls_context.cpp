#include "common/net/tls_context.h"

#include <openssl/bio.h>
#include <openssl/ssl.h>
#include <openssl/x509v3.h>

#include <boost/asio/buffer.hpp>
#include <stdexcept>
#include <string>

#include "common/files/input_file.h"

namespace osteomill {

namespace ssl = boost::asio::ssl;
using boost::system::error_code;

namespace {

/// OpenSSL takes a certificate without extended key usage for every role: a lab's CA may also sign web
/// servers and mail.
template <TlsContext::Role peer>
int verify_with_role(X509_STORE_CTX* chain, void*) {
    if (X509_verify_cert(chain) != 1) return 0;
    if (may_act_as(*X509_STORE_CTX_get0_cert(chain), peer)) return 1;
    X509_STORE_CTX_set_error(chain, X509_V_ERR_INVALID_PURPOSE);
    return 0;
}

}  // namespace

TlsContext::TlsContext(const TlsFiles& files, Role role)
    : role_(role), context_(role == Role::server ? ssl::context::tls_server : ssl::context::tls_client) {
    const std::string certificate = read_text(files.certificate, pem_kind);
    const std::string key = read_secret(files.key, private_key_kind);
    const std::string authorities = read_text(files.ca, pem_kind);
    SSL_CTX* const native = context_.native_handle();
    SSL_CTX_set_min_proto_version(native, TLS1_3_VERSION);
    SSL_CTX_set_session_cache_mode(native, SSL_SESS_CACHE_OFF);
    SSL_CTX_set_num_tickets(native, 0);

    error_code error;
    // Nobody is there to type a passphrase.
    context_.set_password_callback([](std::size_t, ssl::context::password_purpose) { return std::string(); },
                                   error);
    context_.use_certificate_chain(boost::asio::buffer(certificate), error);
    if (error) throw std::runtime_error(files.certificate.string() + ": holds no certificate in PEM form");
    context_.use_private_key(boost::asio::buffer(key), ssl::context::pem, error);
    if (error && ERR_GET_REASON(static_cast<unsigned long>(error.value())) == X509_R_KEY_VALUES_MISMATCH)
        throw std::runtime_error(files.key.string() + ": is not the key of " + files.certificate.string());
    if (error)
        throw std::runtime_error(files.key.string() +
                                 ": holds no private key in PEM form, or one with a passphrase");
    X509& own = *SSL_CTX_get0_certificate(native);
    require_fit(own, files.certificate, role);
    context_.add_certificate_authority(boost::asio::buffer(authorities), error);
    if (error) throw std::runtime_error(files.ca.string() + ": holds no CA certificate in PEM form");
    context_.set_verify_mode(ssl::verify_peer | ssl::verify_fail_if_no_peer_cert);
    SSL_CTX_set_cert_verify_callback(
        native, role == Role::server ? verify_with_role<Role::client> : verify_with_role<Role::server>,
        nullptr);
    if (files.crl.empty()) return;
    revoked_ = std::make_unique<RevocationLists>(files.crl, files.ca, *native);
    if (revoked_->revokes(own))
        throw std::runtime_error(files.certificate.string() + ": is revoked by " + files.crl.string());
}

RevocationLists::Check TlsContext::refresh(RevocationLists::Time now) {
    return revoked_ ? revoked_->refresh(now) : RevocationLists::Check{};
}

bool may_act_as(const X509& certificate, TlsContext::Role role) {
    // It caches its result.
    auto* const uses_of = const_cast<X509*>(&certificate);
    const std::uint32_t uses = X509_get_extended_key_usage(uses_of);
    const bool has_uses = (X509_get_extension_flags(uses_of) & EXFLAG_XKUSAGE) != 0;
    return has_uses && (uses & (role == TlsContext::Role::server ? XKU_SSL_SERVER : XKU_SSL_CLIENT)) != 0;
}

void require_fit(const X509& certificate, const std::filesystem::path& file, TlsContext::Role role) {
    const ASN1_TIME* const from = X509_get0_notBefore(&certificate);
    const ASN1_TIME* const until = X509_get0_notAfter(&certificate);
    if (X509_cmp_current_time(until) <= 0)
        throw std::runtime_error(file.string() + ": has expired, on " + text_of(*until) +
                                 "; a new certificate is needed");
    if (X509_cmp_current_time(from) >= 0)
        throw std::runtime_error(file.string() + ": does not hold before " + text_of(*from) +
                                 "; is this machine's clock right?");
    const bool serves = role == TlsContext::Role::server;
    if (!may_act_as(certificate, role))
        throw std::runtime_error(file.string() + ": is no " + (serves ? "server" : "client") +
                                 "'s certificate: it lacks the extended key usage " +
                                 (serves ? "serverAuth" : "clientAuth"));
}

}  // namespace osteomill
