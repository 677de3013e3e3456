#include "devices/tracker/transform_stream.h"

#include <gmock/gmock.h>
#include <openigtlink/igtlStatusMessage.h>
#include <openigtlink/igtlStringMessage.h>
#include <openigtlink/igtlTransformMessage.h>
#include <openigtlink/igtl_util.h>

#include <glm/gtc/quaternion.hpp>
#include <random>

namespace osteomill {
namespace {

using Bytes = std::vector<std::uint8_t>;

template <typename Message>
Bytes packed(const Message& message) {
    message->Pack();
    const auto* begin = static_cast<const std::uint8_t*>(message->GetPackPointer());
    return {begin, begin + message->GetPackSize()};
}

/// A TRANSFORM as the library's own senders make it.
Bytes transform(const char* name, const glm::dvec3& position_mm, const glm::dquat& turn,
                double stamp_s = 12.5) {
    auto message = igtl::TransformMessage::New();
    message->SetDeviceName(name);
    const glm::dmat3 axes = glm::mat3_cast(turn);
    igtl::Matrix4x4 matrix;
    igtl::IdentityMatrix(matrix);
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column)
            matrix[row][column] = static_cast<float>(axes[column][row]);
        matrix[row][3] = static_cast<float>(position_mm[row]);
    }
    message->SetMatrix(matrix);
    auto stamp = igtl::TimeStamp::New();
    stamp->SetTime(stamp_s);
    message->SetTimeStamp(stamp);
    return packed(message);
}

Bytes string(const char* name, const char* text) {
    auto message = igtl::StringMessage::New();
    message->SetDeviceName(name);
    message->SetString(text);
    return packed(message);
}

struct Heard : ::testing::Test {
    TransformStream stream(const std::string& name = "Drill", const std::string& pedal = "Pedal") {
        return {name,
                pedal,
                {.sample = [this](const TrackerSample& sample) { samples.push_back(sample); },
                 .pedal = [this](bool is_down) { pedals.push_back(is_down); }}};
    }
    const glm::dquat turn = glm::normalize(glm::dquat(0.3, -0.5, 0.7, 0.2));
    std::vector<TrackerSample> samples;
    std::vector<bool> pedals;
};

TEST_F(Heard, ReadsWhatTheLibraryWrites) {
    TransformStream stream = this->stream();
    ASSERT_TRUE(stream.feed(transform("Drill", {1.5, -20.25, 1300.0}, turn)));
    ASSERT_EQ(samples.size(), 1u);
    EXPECT_EQ(samples[0].position_mm, glm::dvec3(1.5, -20.25, 1300.0));
    EXPECT_NEAR(std::abs(glm::dot(samples[0].turn, turn)), 1.0, 1e-7);
    EXPECT_NEAR(samples[0].stamp_s, 12.5, 1e-6);
    for (const char* text : {"1", "on", "TRUE", "down\n", "0", "off", "", "10"})
        ASSERT_TRUE(stream.feed(string("Pedal", text)));
    EXPECT_THAT(pedals, ::testing::ElementsAre(true, true, true, true, false, false, false, false));
    EXPECT_EQ(stream.counts().damaged, 0u);
}

TEST_F(Heard, ReadsBytesHoweverTheyAreCut) {
    Bytes all;
    for (int i = 0; i < 50; ++i) {
        const Bytes one = transform("Drill", glm::dvec3(i), turn);
        const Bytes other =
            i % 3 == 0 ? string("Else", "some text") : transform("Pointer", glm::dvec3(-1.0), turn);
        all.insert(all.end(), other.begin(), other.end());
        all.insert(all.end(), one.begin(), one.end());
    }
    std::mt19937 random(7);
    for (int run = 0; run < 20; ++run) {
        samples.clear();
        TransformStream stream = this->stream();
        std::uniform_int_distribution<std::size_t> length(1, run < 10 ? 5 : 300);
        for (std::size_t at = 0; at < all.size();) {
            const std::size_t count = std::min(length(random), all.size() - at);
            ASSERT_TRUE(stream.feed(std::span(all).subspan(at, count)));
            at += count;
        }
        ASSERT_EQ(samples.size(), 50u);
        for (int i = 0; i < 50; ++i)
            EXPECT_EQ(samples[static_cast<std::size_t>(i)].position_mm, glm::dvec3(i));
        EXPECT_EQ(stream.counts().of_other_names, 33u);
    }
}

TEST_F(Heard, TakesTheFirstNameWhereNoneIsSaid) {
    TransformStream stream = this->stream("");
    ASSERT_TRUE(stream.feed(transform("Pointer", glm::dvec3(1.0), turn)));
    ASSERT_TRUE(stream.feed(transform("Drill", glm::dvec3(2.0), turn)));
    EXPECT_EQ(stream.name(), "Pointer");
    EXPECT_EQ(samples.size(), 1u);
}

/// A message of protocol 3: an extended header of 12 bytes (sizes of itself, metadata's header and metadata;
/// message id) in front, metadata behind.
Bytes with_metadata(const Bytes& plain, const Bytes& header, const std::string& metadata) {
    constexpr std::ptrdiff_t head = 58;
    Bytes body{0, 12, 0, static_cast<std::uint8_t>(header.size()),
               0, 0,  0, static_cast<std::uint8_t>(metadata.size()),
               0, 0,  0, 9};
    body.insert(body.end(), plain.begin() + head, plain.end());
    body.insert(body.end(), header.begin(), header.end());
    body.insert(body.end(), metadata.begin(), metadata.end());
    Bytes message(plain.begin(), plain.begin() + head);
    message[1] = 2;  // version
    message[49] = static_cast<std::uint8_t>(body.size());
    const std::uint64_t crc = crc64(body.data(), body.size(), 0);
    for (std::size_t i = 0; i < 8; ++i) message[50 + i] = static_cast<std::uint8_t>(crc >> (56 - 8 * i));
    message.insert(message.end(), body.begin(), body.end());
    return message;
}

/// The header of one entry: how many, length of the key, encoding, length of the value.
Bytes one_entry(const std::string& key, const std::string& value) {
    return {0, 1, 0, static_cast<std::uint8_t>(key.size()),  0, 3,
            0, 0, 0, static_cast<std::uint8_t>(value.size())};
}

TEST_F(Heard, PassesOverExtendedHeaderAndMetadata) {
    TransformStream stream = this->stream();
    ASSERT_TRUE(stream.feed(with_metadata(transform("Drill", {4.0, 5.0, 6.0}, turn), {0, 0}, "hello")));
    ASSERT_EQ(samples.size(), 1u);
    EXPECT_EQ(samples[0].position_mm, glm::dvec3(4.0, 5.0, 6.0));
}

TEST_F(Heard, TakesAHiddenMarkerForNoSample) {
    const Bytes plain = transform("Drill", {4.0, 5.0, 6.0}, turn);
    for (const auto& [key, value, is_seen] :
         {std::tuple("TransformStatus", "OK", true), std::tuple("TransformStatus", "OUT_OF_VIEW", false),
          std::tuple("Status", "INVALID", false), std::tuple("status", "ok", true),
          std::tuple("TransformValid", "False", false), std::tuple("TransformValid", "True", true),
          std::tuple("Colour", "INVALID", true)}) {
        samples.clear();
        TransformStream stream = this->stream();
        const std::string metadata = std::string(key) + value;
        ASSERT_TRUE(stream.feed(with_metadata(plain, one_entry(key, value), metadata)));
        EXPECT_EQ(samples.size(), is_seen ? 1u : 0u) << metadata;
        EXPECT_EQ(stream.counts().hidden, is_seen ? 0u : 1u) << metadata;
        // Cut off: it says nothing, and is read nowhere beyond its end.
        ASSERT_TRUE(stream.feed(with_metadata(plain, one_entry(key, value), "Stat")));
        ASSERT_TRUE(stream.feed(with_metadata(plain, {0, 9, 0}, "")));
    }
    samples.clear();
    TransformStream stream = this->stream();
    const glm::dquat none(1.0, 0.0, 0.0, 0.0);
    ASSERT_TRUE(stream.feed(transform("Drill", glm::dvec3(0.0), none)));
    EXPECT_TRUE(samples.empty()) << "the identity";
    EXPECT_EQ(stream.counts().hidden, 1u);
    ASSERT_TRUE(stream.feed(transform("Drill", {0.0, 0.0, 0.001}, none)));
    ASSERT_TRUE(stream.feed(transform("Drill", glm::dvec3(0.0), turn)));
    EXPECT_EQ(samples.size(), 2u);
}

TEST_F(Heard, CountsWhatIsDamagedAndGoesOn) {
    const Bytes good = transform("Drill", glm::dvec3(1.0), turn);
    TransformStream stream = this->stream();
    for (std::size_t at = 50; at < good.size(); ++at) {  // the CRC and what it is over
        Bytes bad = good;
        bad[at] ^= 0x10U;
        ASSERT_TRUE(stream.feed(bad));
    }
    EXPECT_TRUE(samples.empty());
    EXPECT_EQ(stream.counts().damaged, good.size() - 50);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    ASSERT_TRUE(stream.feed(transform("Drill", {0.0, nan, 0.0}, turn)));
    ASSERT_TRUE(stream.feed(transform("Drill", glm::dvec3(0.0), 1.01 * turn)));  // scaled by 1.02
    ASSERT_TRUE(stream.feed(transform("Drill", glm::dvec3(0.0), glm::dquat(nan, 0.0, 0.0, 0.0))));
    EXPECT_TRUE(samples.empty());
    ASSERT_TRUE(stream.feed(good));
    EXPECT_EQ(samples.size(), 1u);
}

TEST_F(Heard, GivesUpOnWhatIsNoOpenIGTLink) {
    const Bytes good = transform("Drill", glm::dvec3(1.0), turn);
    Bytes huge = good;
    huge[43] = 1;  // 2^56 bytes of body
    for (const Bytes& bad : {Bytes(58, 0), Bytes(58, 0xFF), huge, Bytes(200, 'G')}) {
        TransformStream stream = this->stream();
        EXPECT_FALSE(stream.feed(bad));
        stream.restart();
        EXPECT_TRUE(stream.feed(good));
    }
    EXPECT_EQ(samples.size(), 4u);
}

TEST_F(Heard, KeepsNothingOfALongMessage) {
    Bytes longer = transform("Drill", glm::dvec3(1.0), turn);
    longer[47] = 1;  // 65536 + 48 bytes
    longer.resize(longer.size() + 65536);
    TransformStream stream = this->stream();
    ASSERT_TRUE(stream.feed(longer));
    EXPECT_TRUE(samples.empty());
    EXPECT_EQ(stream.counts().damaged, 1u);
    ASSERT_TRUE(stream.feed(transform("Drill", glm::dvec3(1.0), turn)));
    EXPECT_EQ(samples.size(), 1u);
}

TEST_F(Heard, SurvivesRandomBytes) {
    std::mt19937 random(3);
    const Bytes good = transform("Drill", glm::dvec3(1.0), turn);
    const Bytes word = string("Pedal", "on");
    for (int run = 0; run < 20'000; ++run) {
        Bytes bytes = run % 2 == 0 ? good : word;
        for (int change = 0; change < 3; ++change)
            bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
        TransformStream stream = this->stream();
        if (stream.feed(bytes)) stream.feed(bytes);
    }
}

}  // namespace
}  // namespace osteomill
