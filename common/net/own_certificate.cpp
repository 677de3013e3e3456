#include "common/net/own_certificate.h"

#include <openssl/bio.h>
#include <openssl/x509v3.h>
#include <sys/stat.h>

#include <array>
#include <cstdio>
#include <stdexcept>
#include <string>

#include "common/net/asn1_time.h"

namespace osteomill {

void require_private(const std::filesystem::path& key) {
    struct stat found {};
    if (::stat(key.c_str(), &found) != 0)
        throw std::runtime_error(key.string() + ": cannot be read; it should be a PEM file");
    // As distributions keep the keys of services: root:ssl-cert, 0640.
    const mode_t allowed = found.st_uid == 0 ? S_IRWXU | S_IRGRP : S_IRWXU;
    const mode_t mode = found.st_mode & (S_IRWXU | S_IRWXG | S_IRWXO);
    if ((mode & ~allowed) == 0) return;
    std::array<char, 8> octal{};
    std::snprintf(octal.data(), octal.size(), "%o", static_cast<unsigned>(mode));
    throw std::runtime_error(key.string() + ": is a private key that others may read (its mode is " +
                             octal.data() + "); keep it to its owner: chmod 600 " + key.string());
}

bool may_act_as(const X509& certificate, TlsContext::Role role) {
    // It keeps what it finds out.
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
