// A streaming server that speaks TLS, and links that do or do not.
#include <gmock/gmock.h>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <optional>
#include <vector>

#include "common/net/tls_context.h"
#include "render_client/link/bone_link.h"
#include "tests/support/lab_certificates.h"
#include "tests/support/messages.h"
#include "tests/support/served_bone.h"

namespace osteomill {
namespace {

using boost::asio::ip::tcp;
using testing::eventually;
using ::testing::HasSubstr;
using testing::LabCertificates;
using testing::ServedBone;

class TlsServer : public ::testing::Test {
  protected:
    void SetUp() override {
        if (!testing::has_openssl()) GTEST_SKIP() << testing::no_openssl;
        lab_.emplace();
        served_ = std::make_unique<ServedBone>(
            0, true, 8, std::nullopt,
            std::make_shared<TlsContext>(lab_->server("bench"), TlsContext::Role::server));
        served_->start_carving();
    }
    static bool says(BoneLink& link, const std::string& words) {
        return eventually([&] { return link.poll().status_line.find(words) != std::string::npos; });
    }
    std::unique_ptr<BoneLink> link(const std::optional<TlsFiles>& tls) {
        return std::make_unique<BoneLink>("127.0.0.1", served_->port(), std::nullopt, tls);
    }

    std::optional<LabCertificates> lab_;
    std::unique_ptr<ServedBone> served_;
};

TEST_F(TlsServer, ServesTheLabAndTurnsAwayTheRestWhileTheLabNoticesNothing) {
    const auto member = link(lab_->client("viewer"));
    ASSERT_TRUE(eventually([&] { return member->poll().checksums_verified >= 1; }));
    const LabCertificates other;
    const auto stranger = link(lab_->impostor(other.client("stranger")));
    EXPECT_TRUE(says(*stranger, "turned this client away: it refuses this program: unknown CA"));
    const auto plain = link(std::nullopt);
    EXPECT_TRUE(says(*plain, "wants certificates (TLS)"));

    boost::asio::io_context io;
    std::vector<tcp::socket> silent;
    for (int i = 0; i < 50; ++i) {
        silent.emplace_back(io).connect({boost::asio::ip::address_v4::loopback(), served_->port()});
    }
    const auto late = link(lab_->client("late"));
    EXPECT_TRUE(eventually([&] { return late->poll().checksums_verified >= 1; }));
    late->send_operator({.pedal = true});
    EXPECT_TRUE(eventually([&] {
        late->send_operator({.pedal = true});
        return served_->operator_command() && served_->operator_command()->pedal;
    }));

    std::thread stopping([&] { served_->stop(); });
    EXPECT_TRUE(eventually([&] { return member->poll().status == LinkStatus::finished; }));
    stopping.join();
    EXPECT_EQ(checksum(*member->bone()), served_->mirror_checksum());
    EXPECT_EQ(member->poll().connections, 1U);
    EXPECT_EQ(member->poll().rejected_frames + member->poll().checksum_mismatches, 0U);
}

TEST_F(TlsServer, IsNotTrustedByALinkOfAnotherLab) {
    const LabCertificates other;
    const auto stranger = link(other.client("viewer"));
    EXPECT_TRUE(says(*stranger, testing::certificate_refused));
    EXPECT_EQ(stranger->poll().status, LinkStatus::refused);
}

TEST_F(TlsServer, IsWhatALinkWithTlsAsksFor) {
    ServedBone plain;
    BoneLink member("127.0.0.1", plain.port(), std::nullopt, lab_->client("viewer"));
    EXPECT_TRUE(says(member, "it does not speak TLS"));
    EXPECT_THROW(BoneLink("127.0.0.1", 7010, std::nullopt, TlsFiles{"/nowhere", "/nowhere", "/nowhere"}),
                 std::runtime_error);
}

}  // namespace
}  // namespace osteomill
