// Command-line options for the access to a server: the same for all programs that serve.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "common/net/listen_address.h"
#include "common/net/tls_options.h"
#include "haptic_server/streaming/streaming_options.h"

namespace osteomill {

struct Access {
    std::optional<TlsFiles> tls;    ///< absent: anyone who reaches the server, unencrypted
    bool insecure_network = false;  ///< and that even for other machines
};

class AccessOptions {
  public:
    /// Adds the options; outlives the parsing.
    explicit AccessOptions(CommandOptions& app);

    /// After parsing. Throws std::invalid_argument, in one line, if only some of the TLS files are named, or
    /// if other machines would be served unencrypted without the option for it.
    Access access_to(const ListenAddress& where) const;
    /// After parsing, for require_distinct.
    std::vector<NamedFile> files_read() const { return tls_.files_read(); }

  private:
    TlsOptions tls_;
    bool insecure_network_ = false;
};

/// The access of a server at `where`. Reads the files of TLS, and throws std::runtime_error, in one
/// line, if they are no good.
StreamingOptions streaming_options(const ListenAddress& where, const Access& access);

}  // namespace osteomill
