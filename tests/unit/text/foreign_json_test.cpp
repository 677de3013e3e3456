#include "common/text/foreign_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>

namespace osteomill {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::ThrowsMessage;

std::string lists(std::size_t depth) {
    return std::string(depth, '[') + std::string(depth, ']');
}

TEST(ForeignJson, IsParsedAsDeepAsItMayBe) {
    EXPECT_EQ(depth_of_json(R"({"a": [1, {"b": 2}], "c": {}})"), 3U);
    EXPECT_EQ(parse_foreign_json(R"({"a": [1, 2]})", "a.json").at("a").size(), 2U);
    EXPECT_NO_THROW(parse_foreign_json(lists(deepest_json), "a.json"));
}

TEST(ForeignJson, IsRefusedInOneLineWhereItIsDeeper) {
    for (const std::size_t depth : {deepest_json + 1, std::size_t{100'000}})
        EXPECT_THAT([&] { parse_foreign_json(lists(depth), "a.json"); },
                    ThrowsMessage<std::runtime_error>(HasSubstr("a.json: its lists")));
    std::string objects;
    for (int i = 0; i < 1000; ++i) objects += R"({"a":)";
    EXPECT_THROW(parse_foreign_json(objects, "a.json"), std::runtime_error);
}

TEST(ForeignJson, CountsNoBracketsOfTexts) {
    const std::string brackets(1000, '[');
    EXPECT_EQ(depth_of_json("[\"" + brackets + "\", \"\\\"" + brackets + "\"]"), 1U);
    EXPECT_EQ(depth_of_json("\"\\\\\"" + lists(2)), 2U) << "the text ended before the lists";
}

/// The library's own parser reads only output of this program itself.
TEST(ForeignJson, IsWhatEveryReaderOfAFileParses) {
    const std::vector<std::string> of_own_texts{"haptic_server/session/session_settings.cpp",
                                                "analysis/report/page_style.cpp",
                                                "common/text/foreign_json.h"};
    const std::regex parse(R"(json::parse\(|Json::parse\(|sax_parse\()");
    std::vector<std::string> others;
    std::size_t found = 0;
    for (const char* const room : {"analysis", "common", "devices", "haptic_server", "imaging", "python",
                                   "render_client", "slicer", "studies"})
        for (const auto& entry : fs::recursive_directory_iterator(fs::path(REPOSITORY) / room)) {
            if (entry.path().extension() != ".cpp" && entry.path().extension() != ".h") continue;
            const std::string file = fs::relative(entry.path(), REPOSITORY).string();
            std::ifstream in(entry.path());
            for (std::string line; std::getline(in, line);) {
                if (!std::regex_search(line, parse)) continue;
                ++found;
                const bool is_own = std::ranges::find(of_own_texts, file) != of_own_texts.end() ||
                                    line.find("parse(metrics_json(") != std::string::npos;
                if (!is_own) others.push_back(file + ": " + line);
            }
        }
    EXPECT_THAT(others, IsEmpty());
    EXPECT_GE(found, of_own_texts.size());
}

}  // namespace
}  // namespace osteomill
