#include "imaging/segmentation/colour_table.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>

#include "imaging/imaging_error.h"
#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace osteomill {
namespace {

using ::testing::HasSubstr;

class ColourTableFile : public ::testing::Test {
  protected:
    void write(const std::string& text) const { std::ofstream(path_) << text; }
    std::string refusal(const std::string& text) const {
        write(text);
        return testing::message_of<std::runtime_error>([&] { read_colour_table(path_); });
    }
    testing::TemporaryFolder folder_;
    std::filesystem::path path_ = folder_ / "colours.ctbl";
};

TEST_F(ColourTableFile, IsReadAsSlicerWritesIt) {
    write(
        "# Color table file\n# 3 values\n0 background 0 0 0 0\n1 Upper_Skull 216 101 79 255\n\n5 canal 0 255 "
        "0 255\n");
    const ColourTable table = read_colour_table(path_);
    EXPECT_EQ(table.size(), 3U);
    EXPECT_EQ(table.at(1), (ColourOfLabel{"Upper Skull", {216, 101, 79}}));
    EXPECT_EQ(table.at(5).name, "canal");
}

TEST_F(ColourTableFile, IsReadAsFreeSurferWritesIt) {
    write("819 Left-HypoThal-noMB 0 80 0 0 2\n7 Rib 12 1 2 3 255\n");
    const ColourTable table = read_colour_table(path_);
    EXPECT_EQ(table.at(819), (ColourOfLabel{"Left-HypoThal-noMB", {0, 80, 0}}));
    EXPECT_EQ(table.at(7), (ColourOfLabel{"Rib 12", {1, 2, 3}}));
}

TEST_F(ColourTableFile, IsReadAsItkSnapWritesIt) {
    write(
        "####\n# ITK-SnAP Label Description File\n    0     0    0    0        0  0  0    \"Clear Label\"\n"
        "    2    70  130  180        1  1  1    \"nerve, left\"\r\n");
    const ColourTable table = read_colour_table(path_);
    EXPECT_EQ(table.at(2), (ColourOfLabel{"nerve, left", {70, 130, 180}}));
}

TEST_F(ColourTableFile, MayEndItsLinesAsOldMacintoshesDid) {
    write("1 ossicle 1 2 3 255\r2 nerve 4 5 6 255\r");
    EXPECT_EQ(read_colour_table(path_).at(2), (ColourOfLabel{"nerve", {4, 5, 6}}));
}

TEST_F(ColourTableFile, IsReadAsTodaysSlicerWritesIt) {
    for (const char* separator : {",", ";"}) {
        std::string text =
            "\xef\xbb\xbfLabelValue,Color_R,Color_G,Color_B,Name\r\n1,244,214,49,facial nerve\r\n2,1,2,3,\"a "
            "\"\"b\"\"\"\r\n";
        if (*separator == ';') std::ranges::replace(text, ',', ';');
        write(text);
        const ColourTable table = read_colour_table(path_);
        EXPECT_EQ(table.at(1), (ColourOfLabel{"facial nerve", {244, 214, 49}}));
        EXPECT_EQ(table.at(2).name, "a \"b\"");
    }
}

TEST_F(ColourTableFile, MayHaveNamesThatAreNoneOrTwice) {
    write(
        "\xef\xbb\xbf# Color table file\r\n0 (none) 0 0 0 0\r\n1 facial nerve 244 214 49 255\r\n50 ctx 1 1 1 "
        "255\r\n51 ctx 1 2 3 255\r\n");
    const ColourTable table = read_colour_table(path_);
    EXPECT_EQ(table.size(), 3U);
    EXPECT_EQ(table.at(1), (ColourOfLabel{"facial nerve", {244, 214, 49}}));
    EXPECT_EQ(table.at(51).name, "ctx");
}

TEST_F(ColourTableFile, IsRefusedInOneLineWhereItIsNone) {
    EXPECT_THAT(refusal(""), HasSubstr("names no label"));
    EXPECT_THAT(refusal("1 bone 1 2\n"), HasSubstr("line 1: is no line of a colour table"));
    EXPECT_THAT(refusal("\n1 bone 1 2 256 255\n"), HasSubstr("line 2"));
    EXPECT_THAT(refusal("70000 bone 1 2 3 255\n"), HasSubstr("line 1"));
    EXPECT_THAT(refusal("1 a 1 2 3 255\n1 b 1 2 3 255\n"), HasSubstr("label 1 comes twice"));
    EXPECT_THAT(refusal("\xff\xfe 1"), HasSubstr("UTF-16"));
    EXPECT_THAT(refusal("LabelValue,Name,Color_R,Color_G,Color_B\n1,a,1,2\n"), HasSubstr("line 2"));
    EXPECT_THAT(refusal(std::string(1'100'000, '#')), HasSubstr("more than the 1000000 that are read"));
    EXPECT_THAT(refusal(std::string("\0\1\2\3 x\"\n", 8)), HasSubstr("line 1"));
    path_ = folder_ / "nowhere";
    EXPECT_THROW(read_colour_table(path_), std::runtime_error);
}

}  // namespace
}  // namespace osteomill
