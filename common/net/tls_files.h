// The files that a program needs to speak TLS.
#pragma once

#include <filesystem>

namespace osteomill {

/// All PEM. scripts/make_lab_certificates.sh makes them.
struct TlsFiles {
    std::filesystem::path certificate;  ///< this program's own, and any intermediate ones up to the CA
    std::filesystem::path key;          ///< the certificate's private key, without a passphrase
    std::filesystem::path ca;           ///< the lab's CA: who may be at the other end
    std::filesystem::path crl{};        ///< the lists of whom it no longer vouches for; empty: none
};

}  // namespace osteomill
