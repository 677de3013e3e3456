#include "common/net/revocation_lists.h"

#include <openssl/bio.h>
#include <openssl/err.h>
#include <openssl/pem.h>
#include <openssl/x509.h>
#include <openssl/x509v3.h>

#include <stdexcept>
#include <utility>

#include "common/files/input_file.h"
#include "common/net/tls_context.h"

namespace osteomill {

namespace {

std::size_t count(const std::string& text, const std::string& what) {
    std::size_t found = 0;
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++found;
    return found;
}

/// All zero if there is no file.
struct stat look_at(const std::filesystem::path& file) {
    struct stat found {};
    if (::stat(file.c_str(), &found) != 0) found = {};
    return found;
}

using Number = std::unique_ptr<ASN1_INTEGER, decltype(&ASN1_INTEGER_free)>;

/// That of the extension; null if the list has none.
Number number_of(const X509_CRL& list) {
    return {static_cast<ASN1_INTEGER*>(X509_CRL_get_ext_d2i(&list, NID_crl_number, nullptr, nullptr)),
            &ASN1_INTEGER_free};
}

/// By their numbers, which a CA only raises, or else by their dates.
bool is_older(const X509_CRL& list, const X509_CRL& than) {
    const Number number = number_of(list);
    const Number number_of_other = number_of(than);
    if (number && number_of_other) return ASN1_INTEGER_cmp(number.get(), number_of_other.get()) < 0;
    return ASN1_TIME_compare(X509_CRL_get0_lastUpdate(&list), X509_CRL_get0_lastUpdate(&than)) < 0;
}

bool is_same(const struct stat& a, const struct stat& b) {
    return a.st_dev == b.st_dev && a.st_ino == b.st_ino && a.st_size == b.st_size &&
           a.st_mtim.tv_sec == b.st_mtim.tv_sec && a.st_mtim.tv_nsec == b.st_mtim.tv_nsec &&
           a.st_ctim.tv_sec == b.st_ctim.tv_sec && a.st_ctim.tv_nsec == b.st_ctim.tv_nsec;
}

}  // namespace

RevocationLists::RevocationLists(std::filesystem::path file, const std::filesystem::path& ca_file,
                                 SSL_CTX& context)
    : file_(std::move(file)), ca_file_(ca_file), context_(context) {
    const STACK_OF(X509_OBJECT)* const objects = X509_STORE_get0_objects(SSL_CTX_get_cert_store(&context_));
    for (int i = 0; i < sk_X509_OBJECT_num(objects); ++i)
        if (X509* const authority = X509_OBJECT_get0_X509(sk_X509_OBJECT_value(objects, i))) {
            X509_up_ref(authority);
            authorities_.emplace_back(authority);
        }
    seen_ = look_at(file_);
    install(read());
}

RevocationLists::~RevocationLists() = default;

RevocationLists::Check RevocationLists::refresh(Time now) {
    if (now - last_look_ < look_period) return {};
    last_look_ = now;
    const struct stat found = look_at(file_);
    if (is_same(found, seen_)) return {};
    seen_ = found;
    try {
        Lists lists = read();
        require_not_older(lists);
        install(std::move(lists));
        return {.has_news = true};
    } catch (const std::runtime_error& error) {
        return {.failure = std::string(error.what()) + "; the list before it holds on"};
    }
}

bool RevocationLists::revokes(X509& certificate) const {
    for (const auto& list : lists_) {
        X509_REVOKED* entry = nullptr;
        if (X509_CRL_get0_by_cert(list.get(), &entry, &certificate) == 1) return true;
    }
    return false;
}

RevocationLists::Lists RevocationLists::read() const {
    const std::string text = read_text(file_, revoked_kind);

    Lists lists;
    const std::unique_ptr<BIO, decltype(&BIO_free)> bytes(
        BIO_new_mem_buf(text.data(), static_cast<int>(text.size())), &BIO_free);
    ERR_clear_error();
    while (X509_CRL* const list = PEM_read_bio_X509_CRL(bytes.get(), nullptr, nullptr, nullptr))
        lists.emplace_back(list);
    const bool read_to_its_end = ERR_GET_REASON(ERR_peek_last_error()) == PEM_R_NO_START_LINE;
    ERR_clear_error();
    if (lists.empty() || !read_to_its_end || lists.size() != count(text, "-----BEGIN"))
        throw std::runtime_error(file_.string() +
                                 ": holds no whole list of revoked certificates in PEM form");
    for (const auto& list : lists) require_good(*list);
    return lists;
}

void RevocationLists::require_good(X509_CRL& list) const {
    const X509_NAME* const issuer = X509_CRL_get_issuer(&list);
    bool is_of_lab = false;
    for (const auto& authority : authorities_) {
        if (X509_NAME_cmp(X509_get_subject_name(authority.get()), issuer) != 0) continue;
        if ((X509_get_key_usage(authority.get()) & KU_CRL_SIGN) == 0)
            throw std::runtime_error(ca_file_.string() +
                                     ": is a CA that may sign no list of revoked certificates: its key usage "
                                     "lacks cRLSign");
        is_of_lab = is_of_lab || X509_CRL_verify(&list, X509_get0_pubkey(authority.get())) == 1;
    }
    ERR_clear_error();
    if (!is_of_lab)
        throw std::runtime_error(file_.string() + ": is not signed by the CA of " + ca_file_.string());
    const ASN1_TIME* const from = X509_CRL_get0_lastUpdate(&list);
    const ASN1_TIME* const until = X509_CRL_get0_nextUpdate(&list);
    if (X509_cmp_current_time(from) >= 0)
        throw std::runtime_error(file_.string() + ": does not hold before " + text_of(*from) +
                                 "; is this machine's clock right?");
    if (until != nullptr && X509_cmp_current_time(until) <= 0)
        throw std::runtime_error(file_.string() + ": has expired, on " + text_of(*until) +
                                 "; a new list is needed (make_lab_certificates.sh FOLDER revoke)");
}

void RevocationLists::require_not_older(const Lists& lists) const {
    for (const auto& list : lists)
        for (const auto& held : lists_)
            if (X509_NAME_cmp(X509_CRL_get_issuer(list.get()), X509_CRL_get_issuer(held.get())) == 0 &&
                is_older(*list, *held))
                throw std::runtime_error(
                    file_.string() + ": is of " + text_of(*X509_CRL_get0_lastUpdate(list.get())) +
                    ", older than the list of " + text_of(*X509_CRL_get0_lastUpdate(held.get())));
}

void RevocationLists::install(Lists lists) {
    X509_STORE* const store = X509_STORE_new();
    if (store == nullptr) throw std::runtime_error("no memory for a list of revoked certificates");
    bool is_complete = true;
    for (const auto& authority : authorities_)
        is_complete = X509_STORE_add_cert(store, authority.get()) == 1 && is_complete;
    for (const auto& list : lists) is_complete = X509_STORE_add_crl(store, list.get()) == 1 && is_complete;
    X509_STORE_set_flags(store, X509_V_FLAG_CRL_CHECK | X509_V_FLAG_CRL_CHECK_ALL);
    if (!is_complete) {
        X509_STORE_free(store);
        throw std::runtime_error("no memory for a list of revoked certificates");
    }
    SSL_CTX_set_cert_store(&context_, store);  // which now owns it
    lists_ = std::move(lists);
}

}  // namespace osteomill
