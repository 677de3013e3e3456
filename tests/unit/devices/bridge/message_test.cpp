#include <gtest/gtest.h>
#include <openssl/evp.h>
#include <openssl/hmac.h>

#include <array>
#include <cmath>
#include <cstring>
#include <glm/gtc/quaternion.hpp>
#include <random>
#include <vector>

#include "bridge/osteomill_bridge.h"

namespace osteomill {
namespace {

using Digest = std::array<std::uint8_t, 32>;
using Message = std::array<std::uint8_t, OMB_MESSAGE_BYTES>;

omb_key key_of(const std::vector<std::uint8_t>& secret) {
    omb_key key;
    omb_set_key(&key, secret.data(), secret.size());
    return key;
}

TEST(BridgeMessage, HasTheHmacOfOpenssl) {
    std::mt19937 random(7);
    for (const std::size_t secret_bytes : {1, 31, 32, 63, 64, 65, 200}) {
        for (const std::size_t bytes : {0, 1, 55, 56, 63, 64, 119, 120, 176, 1000}) {
            std::vector<std::uint8_t> secret(secret_bytes);
            std::vector<std::uint8_t> data(bytes);
            for (auto& byte : secret) byte = static_cast<std::uint8_t>(random());
            for (auto& byte : data) byte = static_cast<std::uint8_t>(random());
            Digest ours{};
            Digest theirs{};
            const omb_key key = key_of(secret);
            omb_hmac(&key, data.data(), data.size(), ours.data());
            HMAC(EVP_sha256(), secret.data(), static_cast<int>(secret.size()), data.data(), data.size(),
                 theirs.data(), nullptr);
            EXPECT_EQ(ours, theirs) << secret_bytes << ' ' << bytes;
        }
    }
}

// So that it is written down in one more place than the header.
TEST(BridgeMessage, LiesOnTheWireAsDocumented) {
    Message message;
    const omb_header header{OMB_POSE, 0x1122334455667788u, 0x0102030405060708u, 5};
    omb_put_header(message.data(), &header);
    omb_pose pose{};
    pose.position_mm[0] = 1.0;
    pose.quaternion[0] = -2.0;
    pose.buttons = OMB_PEDAL;
    pose.status = OMB_READY | OMB_HAS_ORIENTATION;
    omb_put_pose(message.data(), &pose);
    const omb_key none{};
    omb_seal(message.data(), &none);
    const std::vector<std::uint8_t> head{'O',  'S',  'M',  'B',  1,    0,    3,    0,    0x88, 0x77,
                                         0x66, 0x55, 0x44, 0x33, 0x22, 0x11, 0x08, 0x07, 0x06, 0x05,
                                         0x04, 0x03, 0x02, 0x01, 5,    0,    0,    0,    0,    0,
                                         0,    0,    0,    0,    0,    0,    0,    0,    0xf0, 0x3f};
    EXPECT_EQ(std::vector<std::uint8_t>(message.begin(), message.begin() + 40), head);
    EXPECT_EQ(message[32 + 24 + 7], 0xc0);  // -2 as a real number
    EXPECT_EQ(message[32 + 80], 1);
    EXPECT_EQ(message[32 + 84], 5);
    for (std::size_t i = OMB_MESSAGE_BYTES - OMB_TAG_BYTES; i < OMB_MESSAGE_BYTES; ++i)
        EXPECT_EQ(message[i], 0) << "no key, no tag";
}

TEST(BridgeMessage, IsRefusedWithAnyBitFlipped) {
    const omb_key key = key_of(std::vector<std::uint8_t>(32, 9));
    Message message;
    const omb_header header{OMB_FORCE, 3, 4, 5};
    omb_put_header(message.data(), &header);
    const omb_force force{{1, 2, 3}, {4, 5, 6}, 0, 7, 8};
    omb_put_force(message.data(), &force);
    omb_seal(message.data(), &key);
    omb_header read;
    ASSERT_EQ(omb_get_header(message.data(), message.size(), &key, &read), 1);
    EXPECT_EQ(read.kind, OMB_FORCE);
    EXPECT_EQ(read.session, 3u);
    EXPECT_EQ(read.sequence, 4u);
    EXPECT_EQ(read.clock_ns, 5u);
    for (std::size_t bit = 0; bit < 8 * message.size(); ++bit) {
        Message flipped = message;
        flipped[bit / 8] ^= static_cast<std::uint8_t>(1U << (bit % 8));
        EXPECT_EQ(omb_get_header(flipped.data(), flipped.size(), &key, &read), 0) << bit;
    }
    EXPECT_EQ(omb_get_header(message.data(), message.size() - 1, &key, &read), 0);
    const omb_key none{};
    EXPECT_EQ(omb_get_header(message.data(), message.size(), &none, &read), 0);
}

TEST(BridgeMessage, IsReadAsItWasWritten) {
    std::mt19937_64 random(11);
    const auto real = [&] { return std::normal_distribution(0.0, 100.0)(random); };
    for (int i = 0; i < 100; ++i) {
        Message message{};
        omb_arm arm{};
        std::memcpy(arm.name, "an arm", 7);
        for (double* value : {&arm.max_force_n, &arm.max_torque_n_mm, &arm.max_stiffness_n_per_mm,
                              &arm.apparent_mass_kg, &arm.position_step_mm})
            *value = real();
        for (int axis = 0; axis < 3; ++axis) {
            arm.workspace_min_mm[axis] = real();
            arm.workspace_max_mm[axis] = real();
            arm.tool_from_handle_mm[axis] = real();
        }
        const std::uint64_t nonce = random();
        omb_put_hello(message.data(), nonce, &arm);
        omb_arm read;
        EXPECT_EQ(omb_get_hello(message.data(), &read), nonce);
        EXPECT_EQ(std::memcmp(&arm, &read, sizeof arm), 0);
    }
}

TEST(BridgeMessage, ARootIsFoundWithoutAMathLibrary) {
    std::mt19937_64 random(5);
    for (int i = 0; i < 1000; ++i) {
        const double x = std::pow(10.0, std::uniform_real_distribution(-12.0, 12.0)(random));
        EXPECT_NEAR(omb_sqrt(x) / std::sqrt(x), 1.0, 1e-12) << x;
    }
    EXPECT_EQ(omb_sqrt(0.0), 0.0);
    EXPECT_EQ(omb_sqrt(-1.0), 0.0);
    EXPECT_EQ(omb_sqrt(std::nan("")), 0.0);
}

TEST(BridgeMessage, ARotationIsItsQuaternion) {
    std::mt19937_64 random(6);
    const auto real = [&] { return std::normal_distribution(0.0, 1.0)(random); };
    for (int i = 0; i < 1000; ++i) {
        glm::dquat turn = glm::normalize(glm::dquat(real(), real(), real(), real()));
        // Half turns, too, where the real part is nothing.
        if (i % 4 == 0) turn = glm::normalize(glm::dquat(0.0, i % 3 == 0 ? 0.0 : real(), real(), real()));
        const glm::dmat3 matrix(turn);
        double rotation[3][3];
        for (int row = 0; row < 3; ++row)
            for (int column = 0; column < 3; ++column) rotation[row][column] = matrix[column][row];
        double q[4];
        omb_quaternion(rotation, q);
        const double same = std::abs(turn.w * q[0] + turn.x * q[1] + turn.y * q[2] + turn.z * q[3]);
        EXPECT_NEAR(same, 1.0, 1e-12);
    }
}

}  // namespace
}  // namespace osteomill
