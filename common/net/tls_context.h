// Context that all TLS connections of a program share: its own identity, which is checked at the start, and
// the CAs it trusts.
//
// TLS 1.3 and nothing older. Both ends show a certificate of the lab's CA; one that does not is refused. No
// sessions are resumed, so a certificate is checked on every connection.
#pragma once

#include <openssl/asn1.h>
#include <openssl/x509.h>

#include <array>
#include <boost/asio/ssl/context.hpp>
#include <ctime>
#include <filesystem>
#include <memory>
#include <string>

#include "common/net/revocation_lists.h"
#include "common/net/tls_options.h"

namespace osteomill {

class TlsContext {
  public:
    enum class Role { server, client };

    /// Throws std::runtime_error, in one line, if a file cannot be read or holds something else, if the
    /// key is not the certificate's or not kept to its owner, and if the certificate is not for the role,
    /// has expired or is revoked: see require_fit and revocation_lists.h.
    TlsContext(const TlsFiles& files, Role role);

    Role role() const { return role_; }
    boost::asio::ssl::context& context() { return context_; }

    /// Looks whether the list of revoked certificates has changed. On the thread of the connections.
    RevocationLists::Check refresh(RevocationLists::Time now);
    /// Whether that list names the certificate.
    bool revokes(X509& certificate) const { return revoked_ && revoked_->revokes(certificate); }

  private:
    Role role_;
    boost::asio::ssl::context context_;
    std::unique_ptr<RevocationLists> revoked_;  // null: there is no list
};

// Check of a program's own certificate and key at its start. An error would otherwise show as a refusal at
// the other end, or never.

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
