#include <gtest/gtest.h>

#include "haptic_server/streaming/outgoing_frames.h"

namespace osteomill {
namespace {

/// Sends full frames over a link of so many bytes a second.
void send_frames(FramePace& pace, double bytes_per_s, int frames) {
    for (int i = 0; i < frames; ++i)
        pace.wrote(pace.most_bytes(), static_cast<double>(pace.most_bytes()) / bytes_per_s);
}

TEST(FramePace, SettlesWhereALinkTakesAFrameInAQuarterOfASecond) {
    for (const double bytes_per_s : {16e3, 32e3, 100e3}) {
        FramePace pace;
        send_frames(pace, bytes_per_s, 20);
        const double frame_s = static_cast<double>(pace.most_bytes()) / bytes_per_s;
        EXPECT_LE(frame_s, FramePace::longest_s);
        EXPECT_GE(frame_s, 0.5 * FramePace::longest_s - 1e-3);
    }
}

TEST(FramePace, KeepsWithinItsBounds) {
    FramePace pace;
    EXPECT_EQ(pace.most_bytes(), FramePace::most);
    send_frames(pace, 1e9, 5);
    EXPECT_EQ(pace.most_bytes(), FramePace::most);
    pace.wrote(40'000, 30.0);
    EXPECT_EQ(pace.most_bytes(), FramePace::least);
    pace.wrote(150'000, 0.3);  // a part of a snapshot, larger than any state
    EXPECT_EQ(pace.most_bytes(), FramePace::least) << "what took too long lengthens nothing";
    send_frames(pace, 1e9, 5);
    EXPECT_EQ(pace.most_bytes(), FramePace::most);
}

TEST(FramePace, LearnsNothingOfAFastLinkFromASmallFrame) {
    FramePace pace;
    send_frames(pace, 16e3, 20);
    const std::size_t settled = pace.most_bytes();
    for (int i = 0; i < 100; ++i) pace.wrote(150, 1e-5);
    EXPECT_EQ(pace.most_bytes(), settled);
}

}  // namespace
}  // namespace osteomill
