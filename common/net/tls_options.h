// --tls-cert, --tls-key, --tls-ca and --tls-crl, the same for every program.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/files/distinct_files.h"
#include "common/net/tls_files.h"

namespace CLI {
class App;
}

namespace osteomill {

class TlsOptions {
  public:
    /// Adds the options; outlives the parsing.
    explicit TlsOptions(CLI::App& app);
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
