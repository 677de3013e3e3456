// The certificates that the lab has revoked: lists of its CA in a file, read again when that changes.
//
// An expired list revokes nobody and vouches for nobody: while the newest list has expired, every certificate
// is refused, because an attacker who withholds a new list could otherwise use a lost key again. A changed
// file that cannot be used (torn during writing, of another CA, expired, older than the current list) is
// reported once, and the previous lists stay in force.
#pragma once

#include <openssl/ssl.h>
#include <sys/stat.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace osteomill {

class RevocationLists {
  public:
    using Time = std::chrono::steady_clock::time_point;

    /// Shortest time between two checks of the file for changes.
    static constexpr std::chrono::seconds look_period{1};

    /// `context` already knows its CAs. From now on it refuses a certificate that a list names, and every
    /// certificate of a CA that has no list here. Throws std::runtime_error, in one line, if the file holds
    /// no list, or one that is not of a CA of `ca_file`, has expired or does not hold yet. `context` outlives
    /// this.
    RevocationLists(std::filesystem::path file, const std::filesystem::path& ca_file, SSL_CTX& context);
    ~RevocationLists();
    RevocationLists(const RevocationLists&) = delete;
    RevocationLists& operator=(const RevocationLists&) = delete;

    struct Check {
        bool has_news = false;  ///< other lists hold than before
        std::string failure{};  ///< one line; once for each change of the file
    };
    Check refresh(Time now);

    /// Whether the certificate itself is named.
    bool revokes(X509& certificate) const;

  private:
    struct Free {
        void operator()(X509* certificate) const { X509_free(certificate); }
        void operator()(X509_CRL* list) const { X509_CRL_free(list); }
    };
    using Lists = std::vector<std::unique_ptr<X509_CRL, Free>>;

    /// Throws as the constructor does.
    Lists read() const;
    void require_good(X509_CRL& list) const;
    /// Throws std::runtime_error, in one line, if a list is older than the one of its CA that holds: it would
    /// accept again the certificates that the newer one revoked.
    void require_not_older(const Lists& lists) const;
    void install(Lists lists);

    const std::filesystem::path file_;
    const std::filesystem::path ca_file_;
    SSL_CTX& context_;
    std::vector<std::unique_ptr<X509, Free>> authorities_;
    Lists lists_;
    struct stat seen_ {};
    Time last_look_{};
};

}  // namespace osteomill
