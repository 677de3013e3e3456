#include "common/net/own_certificate.h"

#include <openssl/bio.h>
#include <openssl/x509v3.h>

#include <stdexcept>
#include <string>

namespace osteomill {

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
