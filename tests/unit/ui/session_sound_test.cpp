#include "render_client/sound/session_sound.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include "tests/support/eventually.h"
#include "tests/support/temporary_folder.h"

namespace osteomill {
namespace {

TEST(SessionSound, WarnsOfAProtectedStructureWithoutTheSoundOfTheBurr) {
    const testing::TemporaryFolder folder;
    const auto heard = folder / "heard.wav";
    // OpenAL Soft's own card that writes what it is given into a file.
    std::ofstream(folder / "alsoft.conf")
        << "[general]\ndrivers = wave\n[wave]\nfile = " << heard.string() << '\n';
    ::setenv("ALSOFT_CONF", (folder / "alsoft.conf").c_str(), 1);
    const SessionInfo session{
        .burrs = {Burr{}}, .tissues = {{.label = 1, .name = "pulp", .is_protected = true, .warn_mm = 1.0}}};
    const std::vector<StructureDistance> near{{.tissue = 0, .distance_mm = 0.2}};
    ToolState tool;
    SessionSound sound;
    const auto hear = [&](bool warns) {
        tool.time_s += 0.01;
        return sound.hear(tool, &session, near, warns);
    };
    EXPECT_EQ(hear(false), "");
    EXPECT_FALSE(std::filesystem::exists(heard)) << "no loudspeaker is taken that is not needed";
    const auto is_heard = [&] {
        std::ifstream file(heard, std::ios::binary);
        const std::string bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
        constexpr std::size_t header = 100;
        return bytes.size() > header &&
               std::any_of(bytes.begin() + header, bytes.end(), [](char byte) { return byte != 0; });
    };
    EXPECT_TRUE(testing::eventually([&] {
        EXPECT_EQ(hear(true), "");
        return is_heard();
    }));
    EXPECT_FALSE(sound.is_on()) << "of the burr";
}

}  // namespace
}  // namespace osteomill
