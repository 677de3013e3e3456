// A lab's CA and certificates in a folder of a test's own, made by the script that a lab uses.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "common/net/tls_options.h"
#include "tests/support/temporary_folder.h"

namespace osteomill::testing {

/// For GTEST_SKIP.
inline bool has_openssl() {
    return std::system("command -v openssl > /dev/null") == 0;
}
inline constexpr const char* no_openssl = "there is no openssl to make certificates with";

/// The command with the options of these files.
inline std::vector<std::string> with(std::vector<std::string> command, const TlsFiles& files) {
    for (const auto& [option, file] :
         {std::pair("--tls-cert", files.certificate), std::pair("--tls-key", files.key),
          std::pair("--tls-ca", files.ca), std::pair("--tls-crl", files.crl)}) {
        if (file.empty()) continue;
        command.emplace_back(option);
        command.push_back(file.string());
    }
    return command;
}

class LabCertificates {
  public:
    LabCertificates() { make("ca"); }

    /// The files of a server for these hosts, in one string.
    TlsFiles server(const std::string& name, const std::string& hosts = "127.0.0.1 localhost") const {
        make("server " + name + " " + hosts);
        return files(name);
    }
    TlsFiles client(const std::string& name) const {
        make("client " + name);
        return files(name);
    }
    /// A client's whose certificate held until 2024.
    TlsFiles expired_client() const { return expired(client("past"), "clientAuth"); }
    TlsFiles expired_server() const { return expired(server("past"), "serverAuth"); }
    /// A certificate of a CA that knows nothing of roles: without extended key usage.
    TlsFiles client_without_usage() const {
        const TlsFiles files = client("plain");
        sign_anew(files, "keyUsage=critical,digitalSignature", "-days 9");
        return files;
    }
    /// The list of revoked certificates, with one more if a name is given.
    std::filesystem::path revoke(const std::string& name = "") const {
        make("revoke " + name);
        return folder_ / "crl.pem";
    }
    /// Another lab's certificate in the hands of one who knows this lab's CA.
    TlsFiles impostor(const TlsFiles& of_other_lab) const {
        return {.certificate = of_other_lab.certificate, .key = of_other_lab.key, .ca = folder_ / "ca.pem"};
    }
    std::filesystem::path folder() const { return folder_.path(); }

  private:
    TlsFiles files(const std::string& name) const {
        return {.certificate = folder_ / (name + ".pem"),
                .key = folder_ / (name + ".key"),
                .ca = folder_ / "ca.pem"};
    }
    /// The same key with a certificate that held until 2024.
    TlsFiles expired(const TlsFiles& files, const std::string& usage) const {
        sign_anew(files, "extendedKeyUsage=" + usage, "-startdate 20240101000000Z -enddate 20240102000000Z");
        return files;
    }
    /// The same key with another certificate of the lab's CA. By `openssl ca`, since `openssl x509` signs
    /// none that has ended: from OpenSSL 3.4 on it refuses -days -1.
    void sign_anew(const TlsFiles& files, const std::string& extension, const std::string& validity) const {
        const std::string name = files.certificate.stem().string();
        std::ofstream(folder_ / "anew.cnf")
            << "[ca]\ndefault_ca = lab\n[lab]\ndatabase = anew.txt\nnew_certs_dir = .\npolicy = any\n"
               "default_md = sha256\nrand_serial = yes\nunique_subject = no\n[any]\ncommonName = "
               "supplied\n[usage]\n"
            << extension << '\n';
        run("cd " + folder_.path().string() + " && touch anew.txt && openssl req -new -key " + name +
            ".key -subj /CN=" + name + " -out anew.csr && openssl ca -batch -notext -config anew.cnf " +
            "-cert ca.pem -keyfile ca.key -extensions usage " + validity + " -in anew.csr -out " + name +
            ".pem 2> /dev/null");
    }
    void make(const std::string& what) const {
        run(std::string(REPOSITORY "/scripts/make_lab_certificates.sh") + " " + folder_.path().string() +
            " " + what);
    }
    static void run(const std::string& command) {
        if (std::system(command.c_str()) != 0) throw std::runtime_error("failed: " + command);
    }

    TemporaryFolder folder_;
};

}  // namespace osteomill::testing
