// --tls-cert, --tls-key, --tls-ca and --tls-crl, the same for every program.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/files/distinct_files.h"

namespace osteomill {

class CommandOptions;

// The files that a program needs to speak TLS.

/// All PEM. scripts/make_lab_certificates.sh makes them.
struct TlsFiles {
    std::filesystem::path certificate;  ///< this program's own, and any intermediate ones up to the CA
    std::filesystem::path key;          ///< the certificate's private key, without a passphrase
    std::filesystem::path ca;           ///< the lab's CA: who may be at the other end
    std::filesystem::path crl{};        ///< the lists of whom it no longer vouches for; empty: none
};

class TlsOptions {
  public:
    /// Adds the options; outlives the parsing.
    explicit TlsOptions(CommandOptions& app);
    TlsOptions(const TlsOptions&) = delete;
    TlsOptions& operator=(const TlsOptions&) = delete;

    /// After parsing. Throws std::invalid_argument, in one line, unless there are the first three or
    /// none.
    std::optional<TlsFiles> files() const;
    /// The files that were named, for require_distinct.
    std::vector<NamedFile> files_read() const;

  private:
    std::string certificate_;
    std::string key_;
    std::string ca_;
    std::string crl_;
};

}  // namespace osteomill
