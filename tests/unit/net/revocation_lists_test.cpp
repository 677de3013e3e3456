#include "common/net/revocation_lists.h"

#include <gmock/gmock.h>
#include <openssl/pem.h>
#include <openssl/x509.h>

#include <fstream>
#include <stdexcept>

#include "common/net/tls_context.h"
#include "tests/support/lab_certificates.h"
#include "tests/support/message_of.h"

namespace osteomill {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;
using testing::LabCertificates;
using Role = TlsContext::Role;

class RevocationListsTest : public ::testing::Test {
  protected:
    void SetUp() override {
        if (!testing::has_openssl()) GTEST_SKIP() << testing::no_openssl;
        lab_.emplace();
        bench_ = lab_->server("bench");
        bench_.crl = lab_->revoke();
    }
    std::string failure() const {
        return testing::message_of<std::runtime_error>([&] { TlsContext context(bench_, Role::server); });
    }
    std::filesystem::path crl() const { return lab_->folder() / "crl.pem"; }
    void write(const std::string& text) const { std::ofstream(crl()) << text; }
    std::string text() const {
        std::ifstream in(crl());
        return {std::istreambuf_iterator<char>(in), {}};
    }
    /// One that holds between two moments, in seconds from now, and names nobody.
    void write_list(long from_s, long until_s) const {
        const auto open = [&](const char* name) {
            return std::unique_ptr<BIO, decltype(&BIO_free)>(
                BIO_new_file((lab_->folder() / name).c_str(), "r"), &BIO_free);
        };
        X509* const ca = PEM_read_bio_X509(open("ca.pem").get(), nullptr, nullptr, nullptr);
        EVP_PKEY* const key = PEM_read_bio_PrivateKey(open("ca.key").get(), nullptr, nullptr, nullptr);
        X509_CRL* const list = X509_CRL_new();
        X509_CRL_set_version(list, 1);
        X509_CRL_set_issuer_name(list, X509_get_subject_name(ca));
        ASN1_TIME* const time = ASN1_TIME_new();
        X509_gmtime_adj(time, from_s);
        X509_CRL_set1_lastUpdate(list, time);
        X509_gmtime_adj(time, until_s);
        X509_CRL_set1_nextUpdate(list, time);
        X509_CRL_sign(list, key, EVP_sha256());
        const std::unique_ptr<BIO, decltype(&BIO_free)> out(BIO_new_file(crl().c_str(), "w"), &BIO_free);
        PEM_write_bio_X509_CRL(out.get(), list);
        ASN1_TIME_free(time);
        X509_CRL_free(list);
        EVP_PKEY_free(key);
        X509_free(ca);
    }

    std::optional<LabCertificates> lab_;
    TlsFiles bench_;
};

TEST_F(RevocationListsTest, SayInOneLineWhatIsWrongAtTheStart) {
    EXPECT_EQ(failure(), "");
    write_list(-100, 100);
    EXPECT_EQ(failure(), "");
    write_list(-100, -50);
    EXPECT_THAT(failure(), HasSubstr("crl.pem: has expired, on 20"));
    write_list(100, 200);
    EXPECT_THAT(failure(), HasSubstr("crl.pem: does not hold before 20"));
    write("");
    EXPECT_THAT(failure(), HasSubstr("holds no whole list"));
    bench_.crl = bench_.certificate;
    EXPECT_THAT(failure(), HasSubstr("holds no whole list"));
    bench_.crl = "/nowhere/crl.pem";
    EXPECT_THAT(failure(), HasSubstr("/nowhere/crl.pem: cannot be read"));
    bench_.crl = lab_->folder();
    EXPECT_THAT(failure(), HasSubstr("cannot be read"));
    const LabCertificates other;
    bench_.crl = other.revoke();
    EXPECT_THAT(failure(), HasSubstr("is not signed by the CA of"));
    bench_.crl = lab_->revoke("bench");
    EXPECT_THAT(failure(), HasSubstr("bench.pem: is revoked by"));
}

TEST_F(RevocationListsTest, KeepWhatTheyKnowWhileTheFileIsTornAndSayItOnceForEachChange) {
    TlsContext context(bench_, Role::server);
    RevocationLists::Time now{};
    const auto look = [&] { return context.refresh(now += RevocationLists::look_period); };
    EXPECT_EQ(look().failure, "");
    EXPECT_FALSE(look().has_news);

    lab_->client("lost");
    lab_->revoke("lost");
    const std::string whole = text();
    EXPECT_TRUE(look().has_news);
    for (const std::string& torn :
         {whole.substr(0, whole.size() / 2), std::string(), "-----BEGIN X509 CRL-----\n" + whole}) {
        write(torn);
        const auto seen = look();
        EXPECT_FALSE(seen.has_news);
        EXPECT_THAT(seen.failure, HasSubstr("holds no whole list"));
        EXPECT_THAT(seen.failure, HasSubstr("the list before it holds on"));
        EXPECT_EQ(look().failure, "") << "once";
    }
    std::filesystem::remove(crl());
    EXPECT_THAT(look().failure, HasSubstr("cannot be read"));
    EXPECT_EQ(look().failure, "");
    write(whole);
    EXPECT_FALSE(context.refresh(now).has_news) << "so soon it does not look";
    EXPECT_TRUE(look().has_news);
}

TEST_F(RevocationListsTest, GiveWayToNoOlderOne) {
    write_list(-50, 1000);
    const std::string older = text();
    write_list(-40, 1000);
    const std::string newer = text();
    TlsContext context(bench_, Role::server);
    RevocationLists::Time now{};
    const auto look = [&] { return context.refresh(now += RevocationLists::look_period); };
    write(older);
    const auto seen = look();
    EXPECT_FALSE(seen.has_news);
    EXPECT_THAT(seen.failure, HasSubstr("crl.pem: is of 20"));
    EXPECT_THAT(seen.failure, HasSubstr("older than the list of 20"));
    write(newer);
    EXPECT_TRUE(look().has_news) << "the same once more is none older";
    write_list(-30, 1000);
    EXPECT_TRUE(look().has_news);
}

// Two lists that a CA signs within a second bear one date.
TEST_F(RevocationListsTest, GiveWayToNoLowerNumber) {
    const auto number = [&](long value) {
        const std::string folder = lab_->folder().string();
        std::ofstream(lab_->folder() / "crl.number") << (value < 10 ? "0" : "") << value << "\n";
        std::ofstream(lab_->folder() / "numbered.conf")
            << "[ca]\ndefault_ca = lab\n[lab]\ndatabase = " << folder
            << "/revoked.index\ncrlnumber = " << folder << "/crl.number\ndefault_md = sha256\n";
        const std::string command =
            "cd " + folder +
            " && openssl ca -batch -gencrl -crldays 9 -config numbered.conf -cert ca.pem "
            "-keyfile ca.key -out crl.pem 2> numbered.log";
        ASSERT_EQ(std::system(command.c_str()), 0);
    };
    number(12);
    TlsContext context(bench_, Role::server);
    RevocationLists::Time now{};
    const auto look = [&] { return context.refresh(now += RevocationLists::look_period); };
    number(11);
    EXPECT_THAT(look().failure, HasSubstr("older than the list of"));
    number(13);
    EXPECT_TRUE(look().has_news);
}

}  // namespace
}  // namespace osteomill
