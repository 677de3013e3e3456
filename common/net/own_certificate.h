// Check of a program's own certificate and key at its start. An error would otherwise show as a refusal at
// the other end, or never.
#pragma once

#include <openssl/x509.h>

#include <filesystem>

#include "common/net/tls_context.h"

namespace osteomill {

/// Whether the certificate's extended key usage names the role: serverAuth or clientAuth. One without that
/// extension names none.
bool may_act_as(const X509& certificate, TlsContext::Role role);

/// Throws std::runtime_error, in one line, if the certificate has expired, does not hold yet, or lacks the
/// extended key usage of the role: serverAuth or clientAuth. `file` is where it came from.
void require_fit(const X509& certificate, const std::filesystem::path& file, TlsContext::Role role);

}  // namespace osteomill
