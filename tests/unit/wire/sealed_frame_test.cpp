#include "common/wire/sealed_frame.h"

#include <gmock/gmock.h>
#include <xxhash.h>

#include "common/wire/frame.h"

namespace osteomill {
namespace {

using ::testing::HasSubstr;

std::vector<std::uint8_t> message_of(const std::string& stream) {
    FrameDecoder decoder;
    decoder.append({reinterpret_cast<const std::uint8_t*>(stream.data()), stream.size()});
    const auto message = decoder.next();
    return {message->begin(), message->end()};
}

std::vector<std::uint8_t> sealed(const v2::ServerFrame& frame) {
    std::string stream;
    append_sealed_frame(frame, stream);
    return message_of(stream);
}

std::string complaint(const std::vector<std::uint8_t>& message) {
    const auto opened = open_frame(message);
    const auto* error = std::get_if<WireError>(&opened);
    return error != nullptr ? error->line : "";
}

v2::ServerFrame goodbye() {
    v2::ServerFrame frame;
    frame.set_sequence(7);
    frame.mutable_goodbye()->set_reason("the end");
    return frame;
}

TEST(SealedFrame, IsTheMessageAndBehindItTheLowerHalfOfItsXxh3) {
    const std::string plain = goodbye().SerializeAsString();
    const auto checksum = static_cast<std::uint32_t>(XXH3_64bits(plain.data(), plain.size()));
    const auto message = sealed(goodbye());
    ASSERT_EQ(message.size(), plain.size() + seal_bytes);
    EXPECT_EQ(std::string(message.begin(), message.end() - seal_bytes), plain);
    for (std::size_t i = 0; i < 4; ++i)
        EXPECT_EQ(message[plain.size() + 1 + i], static_cast<std::uint8_t>(checksum >> (8 * i)));
    v2::ServerFrame read;
    ASSERT_TRUE(read.ParseFromArray(message.data(), static_cast<int>(message.size())));
    EXPECT_EQ(read.frame_checksum(), checksum) << "any protobuf tool reads it";
    EXPECT_EQ(complaint(message), "");
}

TEST(SealedFrame, CarriesTheTimeAtWhichItIsRecordedUnderItsSeal) {
    const auto message = sealed(goodbye());
    const std::string stamped = with_recorded_time(message, 1'700'000'000'000'000'007);
    EXPECT_EQ(stamped.size(), message.size() + recorded_time_bytes);
    const std::vector<std::uint8_t> bytes(stamped.begin(), stamped.end());
    EXPECT_TRUE(has_sound_seal(bytes));
    const auto opened = open_frame(bytes);
    ASSERT_TRUE(std::holds_alternative<v2::ServerFrame>(opened));
    EXPECT_EQ(std::get<v2::ServerFrame>(opened).recorded_unix_ns(), 1'700'000'000'000'000'007);
    EXPECT_EQ(std::get<v2::ServerFrame>(opened).goodbye().reason(), "the end");
}

TEST(SealedFrame, IsRefusedAfterAnyBitOfTheStreamHasChangedItsLengthToo) {
    std::string stream;
    append_sealed_frame(goodbye(), stream);
    const std::size_t first = stream.size();
    append_sealed_frame(goodbye(), stream);
    for (std::size_t bit = 0; bit < 8 * first; ++bit) {
        std::string bad = stream;
        bad[bit / 8] = static_cast<char>(bad[bit / 8] ^ (1 << bit % 8));
        FrameDecoder decoder;
        decoder.append({reinterpret_cast<const std::uint8_t*>(bad.data()), bad.size()});
        const auto message = decoder.next();
        if (message)
            EXPECT_NE(complaint({message->begin(), message->end()}), "") << bit;
        else
            EXPECT_TRUE(!decoder.error().empty() || decoder.is_inside_frame()) << bit;
    }
}

TEST(SealedFrame, IsRefusedAfterAnyBitHasChanged) {
    const auto good = sealed(goodbye());
    for (std::size_t bit = 0; bit < 8 * good.size(); ++bit) {
        auto bad = good;
        bad[bit / 8] = static_cast<std::uint8_t>(bad[bit / 8] ^ (1U << bit % 8));
        EXPECT_NE(complaint(bad), "") << bit;
    }
}

TEST(SealedFrame, MustHaveItsSeal) {
    std::string stream;
    append_frame(goodbye(), stream);
    EXPECT_THAT(complaint(message_of(stream)), HasSubstr("lacks its checksum"));
}

TEST(SealedFrame, MustHaveItsSealAtTheEnd) {
    auto message = sealed(goodbye());
    const std::string more = goodbye().SerializeAsString();
    message.insert(message.end(), more.begin(), more.end());
    EXPECT_THAT(complaint(message), HasSubstr("not its last field"));
}

}  // namespace
}  // namespace osteomill
