// The programs as they were linked, and the units that start them: hardened as
// cmake/osteomill_hardening.cmake says, and confined.
#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>

#include "tests/support/child_process.h"
#include "tests/support/file_text.h"
#include "tests/support/logged_removal.h"

namespace osteomill::testing {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

bool is_there(const std::string& program) {
    return run_program({"/bin/sh", "-c", "command -v " + program}).status == 0;
}

class Hardening : public ::testing::TestWithParam<const char*> {};

TEST_P(Hardening, IsInTheProgram) {
    if (!IS_HARDENED) GTEST_SKIP() << "only what is optimised, and without sanitizers, is hardened";
    if (!is_there("readelf")) GTEST_SKIP() << "there is no readelf (binutils)";
    const std::string program = std::string(PROGRAMS) + "/" + GetParam();
    const std::string headers = run_program({"/usr/bin/env", "readelf", "-hldW", program}).out;
    EXPECT_THAT(headers, ContainsRegex("Type: +DYN")) << "it is loaded anywhere";
    EXPECT_THAT(headers, HasSubstr("GNU_RELRO"));
    EXPECT_THAT(headers, ContainsRegex("FLAGS_1.*NOW")) << "with all functions found at the start";
    EXPECT_THAT(headers, ContainsRegex("GNU_STACK .* RW ")) << "and no code on the stack";
    const std::string symbols = run_program({"/usr/bin/env", "readelf", "-W", "--dyn-syms", program}).out;
    EXPECT_THAT(symbols, HasSubstr("__stack_chk_fail"));
    EXPECT_THAT(symbols, ContainsRegex("__[a-z]+_chk@")) << "copies are checked";
    const std::string mark("\xf3\x0f\x1e\xfa", 4);  // endbr64; the C library's own code has a handful
    if (run_program({"/bin/uname", "-m"}).out == "x86_64\n") {
        EXPECT_GT(count(text_of(program), mark), 500);
    }
}

INSTANTIATE_TEST_SUITE_P(Of, Hardening,
                         ::testing::Values("haptic_server", "packet_replay", "render_client", "bone_import"),
                         [](const auto& program) { return std::string(program.param); });

TEST(Confinement, OfTheServiceIsWhatSystemdCallsOk) {
    const std::string unit = std::string(SCRIPTS) + "/systemd/osteomill.service";
    if (run_program({"/bin/sh", "-c", "systemd-analyze security --help | grep -q -- --offline"}).status != 0)
        GTEST_SKIP() << "there is no systemd-analyze that judges a unit offline (systemd 250)";
    // In tenths: below 3.0.
    const Finished judged = run_program({"/usr/bin/env", "systemd-analyze", "security", "--offline=yes",
                                         "--threshold=30", "--no-pager", unit});
    EXPECT_EQ(judged.status, 0) << judged.out << judged.err;
    EXPECT_THAT(judged.out, HasSubstr("Overall exposure level for osteomill.service"));
    EXPECT_THAT(judged.err, Not(HasSubstr("Unknown")))
        << "a directive that systemd does not know confines nothing";
    // And yet its loops and its arm have the permissions that they need.
    const std::string text = text_of(unit);
    for (const char* needed :
         {"DeviceAllow=char-hidraw rw", "LimitRTPRIO=50", "LimitMEMLOCK=infinity", "RestrictRealtime=no",
          "SupplementaryGroups=plugdev", "StateDirectory=osteomill", "RuntimeDirectory=osteomill",
          "RestrictAddressFamilies=AF_INET AF_INET6 AF_UNIX"})
        EXPECT_THAT(text, HasSubstr(std::string("\n") + needed + "\n"));
}

TEST(Confinement, GivesRealTimePriorityToAGroupOfItsOwnAlone) {
    std::istringstream limits(text_of(std::string(SCRIPTS) + "/limits/60-osteomill.conf"));
    int rights = 0;
    for (std::string line; std::getline(limits, line);) {
        if (line.empty() || line.front() == '#') continue;
        EXPECT_THAT(line, StartsWith("@osteomill-rt - ")) << "everybody at the machine is in plugdev";
        ++rights;
    }
    EXPECT_EQ(rights, 2);
    EXPECT_THAT(text_of(std::string(SCRIPTS) + "/../debian/osteomill-server.sysusers"),
                HasSubstr("\ng osteomill-rt -\n"))
        << "the package makes it";
}

TEST(Confinement, OfTheContainersLeavesNoCapabilityAndNothingToWriteOn) {
    const std::string compose = text_of(std::string(DOCKER_FOLDER) + "/compose.yaml");
    EXPECT_GE(count(compose, "    image: "), 4);
    EXPECT_EQ(count(compose, "    <<: *confined"), count(compose, "    image: "))
        << "each service is confined";
    for (const char* line :
         {"  cap_drop: [ALL]", "  read_only: true", "  security_opt: [\"no-new-privileges:true\"]"})
        EXPECT_EQ(count(compose, line), 1) << line;
    EXPECT_THAT(compose, HasSubstr("compose.realtime.yaml"));
    for (const char* refused :
         {"cap_add:", "privileged:", "ulimits:", "devices:", "network_mode:", "cpu_rt_"})
        EXPECT_EQ(count(compose, refused), 0) << refused << " is what a host may refuse";
    const std::string realtime = text_of(std::string(DOCKER_FOLDER) + "/compose.realtime.yaml");
    EXPECT_EQ(count(realtime, "\n  server:\n    ulimits: {rtprio: 50, memlock: -1}\n"), 1);
    const std::string image = text_of(std::string(DOCKER_FOLDER) + "/server.Dockerfile");
    std::smatch command;
    ASSERT_TRUE(std::regex_search(image, command, std::regex("\nCMD (.*)\n")));
    EXPECT_THAT(command.str(1), HasSubstr("127.0.0.1:"));
    EXPECT_THAT(command.str(1), Not(HasSubstr("--insecure-network")));
}

}  // namespace
}  // namespace osteomill::testing
