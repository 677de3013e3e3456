#include "analysis/replay/recording_sound.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <limits>

#include "tests/support/file_size_limit.h"
#include "tests/support/made_recording.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/written_session.h"

namespace osteomill::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class RecordingSoundTest : public ::testing::Test {
  protected:
    std::filesystem::path file(const std::string& name) const { return folder_ / name; }

    static void write_sound(const std::filesystem::path& recording, const std::filesystem::path& wav) {
        RecordingSound sound(wav);
        Playhead playhead(recording);
        for (;;) {
            const Playhead::Step step = playhead.step(std::numeric_limits<double>::infinity());
            if (step == Playhead::Step::end) break;
            if (step == Playhead::Step::state) sound.add(playhead);
        }
        sound.close();
    }

    TemporaryFolder folder_;
};

TEST_F(RecordingSoundTest, IsAWavFileAsLongAsTheRecordingAndRepeats) {
    const MadeRecording made = make_recording(file("a.pcap"), {.states = 60});
    write_sound(file("a.pcap"), file("a.wav"));
    write_sound(file("a.pcap"), file("b.wav"));
    EXPECT_EQ(bytes_of(file("a.wav")), bytes_of(file("b.wav")));
    SF_INFO info{};
    SNDFILE* wav = sf_open(file("a.wav").c_str(), SFM_READ, &info);
    ASSERT_NE(wav, nullptr);
    sf_close(wav);
    EXPECT_EQ(info.samplerate, 48'000);
    EXPECT_EQ(info.channels, 1);
    EXPECT_NEAR(static_cast<double>(info.frames), 48'000.0 * made.duration_s(), 1.0);
}

TEST_F(RecordingSoundTest, BeginsAtTheTickThatSwitchedTheSpindle) {
    WrittenSession session(file("a.pcap"), recorded_session_info(),
                           labelled_cube(1, 0.1, [](const glm::dvec3&) { return std::uint8_t{0}; }), {},
                           true);
    constexpr double switched_s = 0.137;
    for (int frame = 0; frame < 6; ++frame) {
        for (int k = 1; k <= 50 && frame > 0; ++k) {
            const double time_s = 0.05 * (frame - 1) + 0.001 * k;
            session.tick({.time_s = time_s, .spindle_on = time_s > switched_s - 1e-9, .burr = 1});
        }
        session.frame({.time_s = 0.05 * frame, .burr = 1, .spindle_on = 0.05 * frame > switched_s});
    }
    session.finish();
    write_sound(file("a.pcap"), file("a.wav"));
    SF_INFO info{};
    SNDFILE* wav = sf_open(file("a.wav").c_str(), SFM_READ, &info);
    ASSERT_NE(wav, nullptr);
    std::vector<float> samples(static_cast<std::size_t>(info.frames));
    sf_read_float(wav, samples.data(), info.frames);
    sf_close(wav);
    const auto heard = std::ranges::find_if(samples, [](float sample) { return sample != 0.0F; });
    EXPECT_NEAR(static_cast<double>(heard - samples.begin()) / info.samplerate, switched_s, 0.005);
}

TEST_F(RecordingSoundTest, OnAFullDiskIsOneLineAndTheOldFileStays) {
    make_recording(file("a.pcap"), {.states = 60});
    write_bytes(file("a.wav"), "old");
    std::string line;
    {
        const FileSizeLimit disk(60'000);
        try {
            write_sound(file("a.pcap"), file("a.wav"));
        } catch (const std::runtime_error& error) {
            line = error.what();
        }
    }
    EXPECT_THAT(line, AllOf(HasSubstr("a.wav"), HasSubstr("cannot write the sound")));
    EXPECT_EQ(bytes_of(file("a.wav")), "old");
    EXPECT_FALSE(std::filesystem::exists(part_of(file("a.wav"))));
}

TEST_F(RecordingSoundTest, IsRefusedWhereThereIsNoFolder) {
    try {
        const RecordingSound sound(file("gone/a.wav"));
        FAIL();
    } catch (const std::runtime_error& error) {
        EXPECT_THAT(error.what(), HasSubstr("gone/a.wav: cannot be written"));
    }
}

}  // namespace
}  // namespace osteomill::testing
