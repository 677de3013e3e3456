#include "haptic_server/replay/replay_options.h"

#include <gmock/gmock.h>

#include <stdexcept>
#include <vector>

namespace osteomill::replay_options_test {
namespace {

ReplayCommandLine parse(std::vector<const char*> arguments) {
    arguments.insert(arguments.begin(), "packet_replay");
    return parse_replay_command_line(static_cast<int>(arguments.size()), arguments.data(), "0.0.test");
}

TEST(ReplayOptions, ServeAtAnySpeedFromAnyTime) {
    const auto plain = parse({"a.pcap"}).options;
    ASSERT_TRUE(plain);
    EXPECT_EQ(plain->recording, "a.pcap");
    EXPECT_EQ(plain->listen.port, 7010);
    EXPECT_FALSE(plain->only_reads());
    const auto other =
        parse({"a.pcap", "--speed", "2.5", "--from-s", "7", "--listen", "127.0.0.1:0"}).options;
    EXPECT_EQ(other->speed, 2.5);
    EXPECT_EQ(other->from_s, 7.0);
    EXPECT_EQ(other->listen.port, 0);
    EXPECT_TRUE(parse({"a.pcap", "--info"}).options->only_reads());
    EXPECT_TRUE(parse({"a.pcap", "--csv", "a.csv"}).options->only_reads());
    EXPECT_TRUE(parse({"a.pcap", "--states-csv", "a.csv"}).options->only_reads());
    EXPECT_TRUE(parse({"a.pcap", "--surface", "a.ply"}).options->only_reads());
    EXPECT_TRUE(parse({"a.pcap", "--difference", "a.nrrd"}).options->only_reads());
    EXPECT_TRUE(parse({"a.pcap", "--sound", "a.wav"}).options->only_reads());
}

TEST(ReplayOptions, AreRefusedWhereTheyMakeNoSense) {
    for (const std::vector<const char*>& wrong : {std::vector<const char*>{},
                                                  {"a.pcap", "--speed", "0"},
                                                  {"a.pcap", "--speed", "nan"},
                                                  {"a.pcap", "--from-s", "-1"},
                                                  {"a.pcap", "--listen", "0.0.0.0:7010"},
                                                  {"a.pcap", "--info", "--speed", "2"},
                                                  {"a.pcap", "--surface", "a.step"},
                                                  {"a.pcap", "--surface", "a.stl", "--csv", "a.stl"},
                                                  {"a.pcap", "--states-csv", "a.csv", "--csv", "a.csv"},
                                                  {"a.pcap", "--difference", "a.stl"},
                                                  {"a.pcap", "--sound", "a.mp3"},
                                                  {"a.pcap", "--sound", "a.wav", "--from-s", "1"},
                                                  {"a.wav", "--sound", "a.wav"},
                                                  {"a.pcap", "--surface", "a.stl", "--speed", "2"},
                                                  {"a.pcap", "--loop"}})
        EXPECT_THROW(parse(wrong), std::invalid_argument);
}

TEST(ReplayOptions, SayWhatThereIs) {
    EXPECT_THAT(parse({"--help"}).text, ::testing::HasSubstr("--from-s"));
    EXPECT_EQ(parse({"--version"}).text, "packet_replay 0.0.test\n");
}

}  // namespace
}  // namespace osteomill::replay_options_test
