// What all TLS connections of a program share: who it is, and whom it trusts.
//
// TLS 1.3 and nothing older. Both ends show a certificate of the lab's CA; one that does not is refused. No
// sessions are resumed, so a certificate is looked at on every connection.
#pragma once

#include <boost/asio/ssl/context.hpp>
#include <memory>

#include "common/net/tls_files.h"

namespace osteomill {

class TlsContext {
  public:
    enum class Role { server, client };

    /// Throws std::runtime_error, in one line, where a file cannot be read, holds something else, or the key
    /// is not the certificate's.
    TlsContext(const TlsFiles& files, Role role);

    Role role() const { return role_; }
    boost::asio::ssl::context& context() { return context_; }

  private:
    Role role_;
    boost::asio::ssl::context context_;
};

}  // namespace osteomill
