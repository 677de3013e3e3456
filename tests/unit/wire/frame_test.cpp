#include "common/wire/frame.h"

#include <gmock/gmock.h>

#include <random>
#include <stdexcept>

#include "osteomill/v2/session.pb.h"

namespace osteomill {
namespace {

using ::testing::HasSubstr;

v2::ServerFrame goodbye(std::uint64_t sequence, std::size_t reason_bytes) {
    v2::ServerFrame frame;
    frame.set_sequence(sequence);
    frame.mutable_goodbye()->set_reason(std::string(reason_bytes, 'x'));
    return frame;
}

std::span<const std::uint8_t> bytes_of(const std::string& text) {
    return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

/// Sequence numbers of all frames that are there.
std::vector<std::uint64_t> take_all(FrameDecoder& decoder) {
    std::vector<std::uint64_t> sequences;
    while (const auto message = decoder.next()) {
        v2::ServerFrame frame;
        EXPECT_TRUE(frame.ParseFromArray(message->data(), static_cast<int>(message->size())));
        sequences.push_back(frame.sequence());
    }
    return sequences;
}

std::string error_after(const std::string& stream) {
    FrameDecoder decoder;
    decoder.append(bytes_of(stream));
    while (decoder.next()) {
    }
    return decoder.error();
}

TEST(Frame, SurvivesASplitAtEveryPosition) {
    std::string stream;
    append_frame(goodbye(1, 0), stream);
    append_frame(goodbye(2, 300), stream);  // a length of two bytes
    append_frame(goodbye(3, 5), stream);
    for (std::size_t split = 0; split <= stream.size(); ++split) {
        FrameDecoder decoder;
        decoder.append(bytes_of(stream).first(split));
        std::vector<std::uint64_t> sequences = take_all(decoder);
        decoder.append(bytes_of(stream).subspan(split));
        for (const std::uint64_t later : take_all(decoder)) sequences.push_back(later);
        ASSERT_THAT(sequences, ::testing::ElementsAre(1, 2, 3)) << "split at " << split;
        ASSERT_FALSE(decoder.is_inside_frame());
    }
}

TEST(Frame, SurvivesArrivingByteByByteAndInRandomPieces) {
    std::mt19937 random(7);
    std::string stream;
    std::vector<std::uint64_t> sent;
    for (std::uint64_t sequence = 1; sequence <= 40; ++sequence) {
        append_frame(goodbye(sequence, random() % 5000), stream);
        sent.push_back(sequence);
    }
    for (const std::size_t longest : {std::size_t{1}, std::size_t{7}, std::size_t{20000}}) {
        FrameDecoder decoder;
        std::vector<std::uint64_t> received;
        for (std::size_t at = 0; at < stream.size();) {
            const std::size_t piece = std::min(stream.size() - at, 1 + random() % longest);
            decoder.append(bytes_of(stream).subspan(at, piece));
            for (const std::uint64_t sequence : take_all(decoder)) received.push_back(sequence);
            at += piece;
        }
        EXPECT_EQ(received, sent);
    }
}

TEST(Frame, HoldsTheLargestMessageAndNoLargerOne) {
    std::size_t reason = largest_frame_bytes;
    while (goodbye(1, reason).ByteSizeLong() > largest_frame_bytes) --reason;
    ASSERT_EQ(goodbye(1, reason).ByteSizeLong(), largest_frame_bytes);
    std::string stream;
    append_frame(goodbye(1, reason), stream);
    FrameDecoder decoder;
    decoder.append(bytes_of(stream));
    EXPECT_THAT(take_all(decoder), ::testing::ElementsAre(1));
    EXPECT_THROW(append_frame(goodbye(1, reason + 1), stream), std::length_error);
}

TEST(Frame, RefusesLengthsThatMakeNoSense) {
    EXPECT_THAT(error_after("\x81\x80\x08"), HasSubstr("over the limit"));  // 131073
    EXPECT_THAT(error_after("\xff\xff\xff\xff\x0f"), HasSubstr("longer than 131072"));
    EXPECT_THAT(error_after(std::string("\0", 1)), HasSubstr("empty"));
    EXPECT_THAT(error_after(std::string("\x81\x00", 2)), HasSubstr("padded"));
    EXPECT_THAT(error_after("GET / HTTP/1.1\r\n\r\n"), "");  // a frame of 71 bytes that has not all come
}

TEST(Frame, FindsNothingAfterAnError) {
    FrameDecoder decoder;
    decoder.append(bytes_of(std::string("\0", 1)));
    EXPECT_FALSE(decoder.next());
    std::string good;
    append_frame(goodbye(1, 3), good);
    decoder.append(bytes_of(good));
    EXPECT_FALSE(decoder.next());
    EXPECT_FALSE(decoder.error().empty());
}

TEST(Frame, SaysThatAStreamEndedInsideAFrame) {
    std::string stream;
    append_frame(goodbye(1, 30), stream);
    FrameDecoder decoder;
    decoder.append(bytes_of(stream).first(stream.size() - 1));
    EXPECT_FALSE(decoder.next());
    EXPECT_TRUE(decoder.is_inside_frame());
}

TEST(Frame, NeitherCrashesNorGrowsOnRandomBytes) {
    std::mt19937 random(11);
    for (int round = 0; round < 2000; ++round) {
        FrameDecoder decoder;
        std::string noise(random() % 64, '\0');
        for (char& c : noise) c = static_cast<char>(random());
        decoder.append(bytes_of(noise));
        std::size_t taken = 0;
        while (const auto message = decoder.next()) taken += message->size();
        EXPECT_LE(taken, noise.size());
    }
}

}  // namespace
}  // namespace osteomill
