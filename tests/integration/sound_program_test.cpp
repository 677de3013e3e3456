// The burr heard: from a recording, as a file, and from a client, through a sound card that is none. The real
// programs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sndfile.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "common/files/atomic_file.h"
#include "common/files/session_file.h"
#include "tests/support/block_file.h"
#include "tests/support/child_process.h"
#include "tests/support/file_text.h"
#include "tests/support/strongest_note.h"
#include "tests/support/temporary_folder.h"

namespace osteomill::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

struct Sound {
    double rate_hz = 0.0;
    std::vector<float> samples{};  // the first channel's

    std::span<const float> between(double from_s, double to_s) const {
        const auto at = [&](double time_s) {
            return std::min(samples.size(), static_cast<std::size_t>(time_s * rate_hz));
        };
        return std::span(samples).subspan(at(from_s), at(to_s) - at(from_s));
    }
    double note_hz(double from_s, double to_s) const { return strongest_hz(between(from_s, to_s), rate_hz); }
};

Sound sound_in(const std::string& file) {
    SF_INFO info{};
    SNDFILE* wav = sf_open(file.c_str(), SFM_READ, &info);
    if (wav == nullptr) throw std::runtime_error(file + ": " + sf_strerror(nullptr));
    std::vector<float> all(static_cast<std::size_t>(info.frames * info.channels));
    const sf_count_t read = sf_readf_float(wav, all.data(), info.frames);
    sf_close(wav);
    Sound sound{.rate_hz = static_cast<double>(info.samplerate)};
    for (sf_count_t i = 0; i < read; ++i)
        sound.samples.push_back(all[static_cast<std::size_t>(i * info.channels)]);
    return sound;
}

/// A 2 mm burr with four edges at 21 000 rpm, 1400 Hz: into a block from 0.9 s on, out of it from 2.4 s on.
class SoundProgram : public ::testing::Test {
  protected:
    SoundProgram() { write_block(file("block.nrrd")); }

    std::string file(const std::string& name) const { return (folder_ / name).string(); }

    void record(const std::string& name, const std::string& motor = {}) const {
        std::ofstream(file("path.csv")) << "t_s,x_mm,y_mm,z_mm,axis_x,axis_y,axis_z,pedal\n"
                                           "0.0,-1,0,3.5,0,0,1,1\n"
                                           "0.8,-1,0,3.5,0,0,1,1\n"
                                           "1.4,-1,0,1.0,0,0,1,1\n"
                                           "2.4,1,0,1.0,0,0,1,1\n"
                                           "2.8,1,0,4.0,0,0,1,1\n"
                                           "3.3,1,0,4.0,0,0,1,0\n"
                                           "6.5,1,0,4.0,0,0,1,0\n";
        std::ofstream(file("scene.toml"))
            << "name = \"block\"\n[bone]\nfile = \"block.nrrd\"\n[[burrs]]\nname = \"2 mm\"\ndiameter_mm = "
               "2\n"
               "edges = 4\nrpm = 21000\n[start_pose]\nposition_mm = [-1, 0, 3.5]\n"
               "[trajectory]\nfile = \"path.csv\"\n"
            << motor;
        const Finished finished =
            run_program({HAPTIC_SERVER, "--scene", file("scene.toml"), "--clock", "virtual", "--duration-s",
                         "6", "--json", file(name + ".json"), "--record", file(name)});
        ASSERT_EQ(finished.status, 0) << finished.err;
    }
    Sound sound_of(const std::string& recording) const {
        const Finished finished =
            run_program({PACKET_REPLAY, file(recording), "--sound", file(recording + ".wav")});
        EXPECT_EQ(finished.status, 0) << finished.err;
        return sound_in(file(recording + ".wav"));
    }
    /// Plays a recording to a sound card that `environment` chooses, drawing offscreen meanwhile.
    Finished play(const std::string& recording, const std::string& environment, int frames) const {
        // OpenGL drivers leak and are unloaded before the leak checker of an instrumented client looks.
        return run_program({"/usr/bin/env", "ASAN_OPTIONS=detect_leaks=0", environment, RENDER_CLIENT,
                            "--offscreen", "--window-size", "64x48", "--replay", file(recording), "--sound",
                            "--frames", std::to_string(frames), "--json", file("client.json")});
    }

    TemporaryFolder folder_;
};

TEST_F(SoundProgram, OfARecordingHasItsPeakAtEdgesTimesRevolutionsAndRepeats) {
    record("a.pcap");
    const Sound sound = sound_of("a.pcap");
    EXPECT_NEAR(sound.note_hz(0.0, 6.0), 1400.0, 14.0);
    EXPECT_NEAR(sound.note_hz(1.5, 2.4), 1400.0, 14.0);
    EXPECT_GT(rms(sound.between(1.5, 2.4)), 3.0 * rms(sound.between(2.9, 3.2))) << "in bone and in air";
    EXPECT_GT(rms(sound.between(2.9, 3.2)), 0.001);
    EXPECT_EQ(rms(sound.between(5.5, 5.9)), 0.0) << "the spindle stands";
    const std::string once = text_of(file("a.pcap.wav"));
    sound_of("a.pcap");
    EXPECT_EQ(text_of(file("a.pcap.wav")), once);
}

TEST_F(SoundProgram, OfAMotorFallsUnderLoadAndNothingElseChanges) {
    record("a.pcap");
    record("weak.pcap", "[motor]\nstall_torque_n_mm = 4.0\n");
    const double note_hz = sound_of("weak.pcap").note_hz(1.6, 2.3);
    EXPECT_LT(note_hz, 0.98 * 1400.0);
    EXPECT_GT(note_hz, 0.3 * 1400.0);
    record("stalls.pcap", "[motor]\nstall_torque_n_mm = 0.01\n");
    EXPECT_NEAR(sound_of("stalls.pcap").note_hz(1.8, 2.3), 100.0, 3.0) << "the motor growls";
    EXPECT_NEAR(sound_of("stalls.pcap").note_hz(0.5, 0.8), 350.0, 10.0) << "in air it whines";
    const auto line_of = [this](const std::string& json, const std::string& key) {
        std::ifstream in(file(json));
        for (std::string line; std::getline(in, line);)
            if (line.find('"' + key + '"') != std::string::npos) return line;
        return std::string();
    };
    for (const char* key : {"bone_checksum", "peak_force_n"}) {
        EXPECT_THAT(line_of("a.pcap.json", key), Not(""));
        EXPECT_EQ(line_of("stalls.pcap.json", key), line_of("a.pcap.json", key));
    }
}

TEST_F(SoundProgram, OfATornRecordingIsAsLongAsCanBeRead) {
    record("a.pcap");
    const double whole_s = static_cast<double>(sound_of("a.pcap").samples.size()) / 48'000.0;
    std::filesystem::resize_file(file("a.pcap"), std::filesystem::file_size(file("a.pcap")) * 2 / 3);
    const Finished torn = run_program({PACKET_REPLAY, file("a.pcap"), "--sound", file("torn.wav"), "--info"});
    EXPECT_THAT(torn.out, HasSubstr("end         within a frame"));
    const double torn_s = static_cast<double>(sound_in(file("torn.wav")).samples.size()) / 48'000.0;
    EXPECT_GT(torn_s, 0.1);
    EXPECT_LT(torn_s, whole_s);
}

TEST_F(SoundProgram, OnAFullDiskIsOneLineAndNoFile) {
    record("a.pcap");
    const Finished full = run_program(
        {"/bin/bash", "-c",
         "ulimit -f 100; exec " PACKET_REPLAY " " + file("a.pcap") + " --sound " + file("full.wav")});
    EXPECT_EQ(full.status, 1);
    EXPECT_THAT(full.err, HasSubstr("full.wav: cannot write the sound"));
    EXPECT_EQ(std::count(full.err.begin(), full.err.end(), '\n'), 1) << full.err;
    EXPECT_FALSE(std::filesystem::exists(file("full.wav")));
    EXPECT_FALSE(std::filesystem::exists(part_of(file("full.wav"))));
}

TEST_F(SoundProgram, ComesOutOfAClientsSoundCard) {
    record("a.pcap");
    // OpenAL Soft's own card that writes what it is given into a file.
    std::ofstream(file("alsoft.conf"))
        << "[general]\ndrivers = wave\nfrequency = 48000\n[wave]\nfile = " << file("heard.wav") << '\n';
    const Finished played = play("a.pcap", "ALSOFT_CONF=" + file("alsoft.conf"), 120);
    ASSERT_EQ(played.status, 0) << played.err;
    EXPECT_EQ(played.err, "");
    const Sound heard = sound_in(file("heard.wav"));
    EXPECT_GT(rms(heard.samples), 0.005);
    EXPECT_NEAR(strongest_hz(heard.samples, heard.rate_hz), 1400.0, 14.0);
}

TEST_F(SoundProgram, BeginsAndEndsWithACardThatIsNone) {
    record("a.pcap");
    const Finished played = play("a.pcap", "ALSOFT_DRIVERS=null", 20);
    EXPECT_EQ(played.status, 0) << played.err;
    EXPECT_EQ(played.err, "");
}

TEST_F(SoundProgram, WithoutASoundCardIsOneLineAndThePictureGoesOn) {
    record("a.pcap");
    const Finished played = play("a.pcap", "ALSOFT_DRIVERS=solaris", 5);
    EXPECT_EQ(played.status, 0) << played.err;
    EXPECT_THAT(played.err, HasSubstr("no sound: OpenAL finds no output"));
    EXPECT_EQ(std::count(played.err.begin(), played.err.end(), '\n'), 1) << played.err;
    EXPECT_THAT(text_of(file("client.json")), HasSubstr("\"frames\""));
}

}  // namespace
}  // namespace osteomill::testing
