// Context that all TLS connections of a program share: its own identity, and the CAs it trusts.
//
// TLS 1.3 and nothing older. Both ends show a certificate of the lab's CA; one that does not is refused. No
// sessions are resumed, so a certificate is checked on every connection.
#pragma once

#include <boost/asio/ssl/context.hpp>
#include <memory>

#include "common/net/revocation_lists.h"
#include "common/net/tls_options.h"

namespace osteomill {

class TlsContext {
  public:
    enum class Role { server, client };

    /// Throws std::runtime_error, in one line, if a file cannot be read or holds something else, if the
    /// key is not the certificate's or not kept to its owner, and if the certificate is not for the role,
    /// has expired or is revoked: see own_certificate.h and revocation_lists.h.
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

}  // namespace osteomill
