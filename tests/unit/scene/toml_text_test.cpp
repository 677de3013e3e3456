#include "common/scene/toml_text.h"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <fstream>

#include "common/scene/scene_file.h"
#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace osteomill {
namespace {

using ::testing::HasSubstr;

std::string refusal(const std::string& text) {
    return testing::message_of<SceneError>([&] { parse_toml(text, "x.toml"); });
}

std::string dotted(int parts) {
    std::string key = "a";
    for (int i = 1; i < parts; ++i) key += ".a";
    return key;
}

TEST(TomlText, AcceptsWhatScenesHold) {
    EXPECT_EQ(refusal("name = \"a.b.c\"\n[stiffness]\nknots = [[150.0, 0.02], [1600.5, 1.0]] # ...\n"), "");
    EXPECT_EQ(refusal(dotted(32) + " = 1"), "");
    EXPECT_EQ(refusal("dots = \"" + std::string(500, '.') + "\" # " + std::string(500, '.')), "");
    EXPECT_EQ(refusal("long = '''\n" + std::string(500, '.') + "\n'''"), "");
}

TEST(TomlText, RefusesKeysOfManyPartsWhereverTheyStand) {
    EXPECT_EQ(refusal("b = 1\n" + dotted(33) + " = 1"), "x.toml:2: a key of more than 32 parts");
    EXPECT_THAT(refusal("[" + dotted(100'000) + "]"), HasSubstr("32 parts"));
    EXPECT_THAT(refusal("[[" + dotted(33) + "]]"), HasSubstr("32 parts"));
    EXPECT_THAT(refusal("t = {" + dotted(33) + " = 1}"), HasSubstr("32 parts"));
    std::string quoted = "\"=\"";
    for (int i = 0; i < 40; ++i) quoted += ".'='";
    EXPECT_THAT(refusal(quoted), HasSubstr("32 parts"));
}

// toml++ 3.3 takes for granted that a name begins behind "[[": an assertion, or whatever a compiler makes of
// one.
TEST(TomlText, RefusesATableWithoutAName) {
    for (const char* text : {"[[[", "[[[[[[[[", "[[=]]", "[ [[", "a = 1\n\t[[\n", "[.", "[[\xc3\xa4]]", "[#",
                             "[[]]", "\xef\xbb\xbf[[!"})
        EXPECT_THAT(refusal(text), HasSubstr("x.toml:")) << text;
    for (const char* text : {"[a]", "[[ a ]]", "[\"b\"]", "[ 'c' ]", "[-_9.d]", "a = [[1], [2],\n[3]]",
                             "a = [\n[[1]]\n]", "[a]\nb = '[['\n# [[!"})
        EXPECT_EQ(refusal(text), "") << text;
}

TEST(TomlText, SaysWhereItIsNoToml) {
    EXPECT_THAT(refusal("a = 1\nb = "), HasSubstr("x.toml:2: not TOML: "));
}

TEST(TomlText, IsNotLedAstrayByStrings) {
    EXPECT_THAT(refusal(R"(t = {a = """b"""", )" + dotted(33) + " = 1}"), HasSubstr("32 parts"))
        << "a quote before the closing three";
    EXPECT_THAT(refusal(R"(t = {a = "b\"", )" + dotted(33) + " = 1}"), HasSubstr("32 parts"));
    EXPECT_THAT(refusal(R"(t = {a = 'b\', )" + dotted(33) + " = 1}"), HasSubstr("32 parts"));
    EXPECT_THAT(refusal("a = \"open\n" + dotted(33) + " = 1"), HasSubstr("32 parts"));
}

TEST(TomlText, RefusesDeepBracketsAndLargeTexts) {
    EXPECT_EQ(refusal("a = " + std::string(33, '[')), "x.toml:1: more than 32 brackets within one another");
    EXPECT_THAT(refusal(std::string(most_toml_bytes + 1, '\n')), HasSubstr("are more than"));
}

TEST(TomlText, ReadsFilesOnly) {
    testing::TemporaryFolder folder;
    const auto refused = [&](const std::filesystem::path& path) -> std::string {
        try {
            return read_toml_text(path, "a scene file");
        } catch (const SceneError& error) {
            return error.what();
        }
    };
    std::ofstream(folder / "good.toml") << "a = 1\n";
    EXPECT_EQ(refused(folder / "good.toml"), "a = 1\n");
    EXPECT_THAT(refused(folder / "none.toml"), HasSubstr("cannot be read"));
    EXPECT_THAT(refused("/dev/zero"), HasSubstr("a pipe or a device"));
    ASSERT_EQ(::mkfifo((folder / "pipe.toml").c_str(), 0600), 0);
    EXPECT_THAT(refused(folder / "pipe.toml"), HasSubstr("a pipe or a device"))
        << "without waiting for a writer";
}

}  // namespace
}  // namespace osteomill
