#include <gmock/gmock.h>

#include <stdexcept>

#include "common/net/tls_context.h"
#include "tests/support/lab_certificates.h"
#include "tests/support/message_of.h"

namespace osteomill {
namespace {

using ::testing::HasSubstr;
using testing::LabCertificates;
using ::testing::StartsWith;
using Role = TlsContext::Role;

std::string failure_of(const TlsFiles& files, Role role) {
    return testing::message_of<std::runtime_error>([&] { TlsContext context(files, role); });
}

TEST(OwnCertificate, IsRefusedWhereItIsForTheOtherRoleHasExpiredOrSaysNoRole) {
    if (!testing::has_openssl()) GTEST_SKIP() << testing::no_openssl;
    const LabCertificates lab;
    const TlsFiles bench = lab.server("bench");
    const TlsFiles viewer = lab.client("viewer");
    EXPECT_EQ(failure_of(bench, Role::server), "");
    EXPECT_EQ(failure_of(viewer, Role::client), "");
    EXPECT_THAT(failure_of(bench, Role::client), HasSubstr("lacks the extended key usage clientAuth"));
    EXPECT_THAT(failure_of(viewer, Role::server), HasSubstr("lacks the extended key usage serverAuth"));
    EXPECT_THAT(failure_of(lab.expired_client(), Role::client), HasSubstr("past.pem: has expired, on 20"));

    // One without any extension; the CA's own key will do.
    const std::string folder = lab.folder().string();
    ASSERT_EQ(
        std::system(("cd " + folder +
                     " && openssl req -x509 -key bench.key -subj /CN=bare -days 9 -out bare.pem 2> bare.log")
                        .c_str()),
        0);
    EXPECT_THAT(failure_of({folder + "/bare.pem", bench.key, bench.ca}, Role::server),
                HasSubstr("serverAuth"));
}

}  // namespace
}  // namespace osteomill
