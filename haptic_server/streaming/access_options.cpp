#include "haptic_server/streaming/access_options.h"

#include <fmt/format.h>

#include <stdexcept>

#include "common/net/tls_context.h"
#include "common/program/command_options.h"

namespace osteomill {

AccessOptions::AccessOptions(CommandOptions& app) : tls_(app) {
    app.add_flag("--insecure-network", insecure_network_,
                 "Serve other machines, too, without TLS: anyone who reaches the port sees everything, and "
                 "may drill");
}

Access AccessOptions::access_to(const ListenAddress& where) const {
    const Access access{.tls = tls_.files(), .insecure_network = insecure_network_};
    if (!is_loopback(where) && !access.tls && !access.insecure_network)
        throw std::invalid_argument(
            fmt::format("--listen: '{}' can be reached from other machines, which takes TLS (--tls-cert, "
                        "--tls-key, --tls-ca), or --insecure-network where all of them are trusted",
                        where.address));
    return access;
}

StreamingOptions streaming_options(const ListenAddress& where, const Access& access) {
    return {.address = where.address,
            .port = where.port,
            .tls = access.tls ? std::make_shared<TlsContext>(*access.tls, TlsContext::Role::server) : nullptr,
            .insecure_network = access.insecure_network};
}

}  // namespace osteomill
