// Check of a program's own certificate and key at its start. An error would otherwise show as a refusal at
// the other end, or never.
#pragma once

#include <openssl/asn1.h>
#include <openssl/x509.h>

#include <array>
#include <ctime>
#include <filesystem>
#include <string>

#include "common/net/tls_context.h"

namespace osteomill {

/// Whether the certificate's extended key usage names the role: serverAuth or clientAuth. One without that
/// extension names none.
bool may_act_as(const X509& certificate, TlsContext::Role role);

/// Throws std::runtime_error, in one line, if the certificate has expired, does not hold yet, or lacks the
/// extended key usage of the role: serverAuth or clientAuth. `file` is where it came from.
void require_fit(const X509& certificate, const std::filesystem::path& file, TlsContext::Role role);

// A time in a certificate or a list of revoked ones, for a message.

/// Such as "2026-11-22 19:30:00 UTC".
inline std::string text_of(const ASN1_TIME& time) {
    std::tm parts{};
    std::array<char, 64> text{};
    if (ASN1_TIME_to_tm(&time, &parts) != 1 ||
        std::strftime(text.data(), text.size(), "%Y-%m-%d %H:%M:%S UTC", &parts) == 0)
        return "an unknown time";
    return text.data();
}

}  // namespace osteomill
