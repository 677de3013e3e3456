#include "common/net/tls_context.h"

#include <gmock/gmock.h>

#include <fstream>

#include "tests/support/lab_certificates.h"
#include "tests/support/message_of.h"

namespace osteomill {
namespace {

using testing::LabCertificates;

std::string failure_of(const TlsFiles& files) {
    return testing::message_of<std::runtime_error>(
        [&] { TlsContext context(files, TlsContext::Role::server); });
}

TEST(TlsContext, SaysInOneLineWhichFileIsNoGood) {
    if (!testing::has_openssl()) GTEST_SKIP() << testing::no_openssl;
    const LabCertificates lab;
    const TlsFiles good = lab.server("bench");
    EXPECT_EQ(failure_of(good), "");

    const auto with = [&](auto member, const std::filesystem::path& file) {
        TlsFiles files = good;
        files.*member = file;
        return failure_of(files);
    };
    const std::filesystem::path text = lab.folder() / "text.pem";
    std::ofstream(text) << "no PEM\n";
    std::filesystem::permissions(text, std::filesystem::perms::owner_read);
    EXPECT_THAT(with(&TlsFiles::certificate, "/nowhere/a.pem"),
                ::testing::StartsWith("/nowhere/a.pem: cannot be read"));
    EXPECT_THAT(with(&TlsFiles::key, lab.folder()), ::testing::HasSubstr("cannot be read"));
    EXPECT_THAT(with(&TlsFiles::certificate, text), ::testing::HasSubstr("text.pem: holds no certificate"));
    EXPECT_THAT(with(&TlsFiles::key, text), ::testing::HasSubstr("text.pem: holds no private key"));
    EXPECT_THAT(with(&TlsFiles::ca, text), ::testing::HasSubstr("text.pem: holds no CA certificate"));
    EXPECT_THAT(with(&TlsFiles::key, lab.client("viewer").key),
                ::testing::HasSubstr("viewer.key: is not the key of " + good.certificate.string()));
}

TEST(LabCertificates, KeepTheirKeysToTheirOwnerAndAreNeverOverwritten) {
    if (!testing::has_openssl()) GTEST_SKIP() << testing::no_openssl;
    const LabCertificates lab;
    lab.client("viewer");
    for (const char* key : {"ca.key", "viewer.key"})
        EXPECT_EQ(std::filesystem::status(lab.folder() / key).permissions(),
                  std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
    EXPECT_THROW(lab.client("viewer"), std::runtime_error);
    EXPECT_THROW(lab.client("../viewer"), std::runtime_error);
    EXPECT_THROW(lab.server("bench", "no/host"), std::runtime_error);
}

}  // namespace
}  // namespace osteomill
