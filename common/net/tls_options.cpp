#include "common/net/tls_options.h"

#include <stdexcept>
#include <utility>

#include "common/program/command_options.h"

namespace osteomill {

TlsOptions::TlsOptions(CommandOptions& app) {
    app.add_option("--tls-cert", certificate_, "Speak TLS 1.3, and show this certificate")
        .type_name("FILE.pem");
    app.add_option("--tls-key", key_, "Its private key").type_name("FILE.pem");
    app.add_option("--tls-ca", ca_, "The lab's CA: only whom it vouches for may be at the other end")
        .type_name("FILE.pem");
    app.add_option(
           "--tls-crl", crl_,
           "Whom the CA no longer vouches for: its list of revoked certificates, read again when it changes; "
           "an expired list refuses everybody")
        .type_name("FILE.pem");
}

std::optional<TlsFiles> TlsOptions::files() const {
    if (certificate_.empty() && key_.empty() && ca_.empty() && crl_.empty()) return std::nullopt;
    for (const auto& [option, file] :
         {std::pair("--tls-cert", &certificate_), std::pair("--tls-key", &key_), std::pair("--tls-ca", &ca_)})
        if (file->empty())
            throw std::invalid_argument(std::string(option) +
                                        ": is missing; TLS needs --tls-cert, --tls-key and --tls-ca");
    return TlsFiles{.certificate = certificate_, .key = key_, .ca = ca_, .crl = crl_};
}

std::vector<NamedFile> TlsOptions::files_read() const {
    std::vector<NamedFile> files;
    for (const auto& [option, file] : {std::pair("--tls-cert", &certificate_), std::pair("--tls-key", &key_),
                                       std::pair("--tls-ca", &ca_), std::pair("--tls-crl", &crl_)})
        if (!file->empty()) files.push_back({option, *file, false});
    return files;
}

}  // namespace osteomill
