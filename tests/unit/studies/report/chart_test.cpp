#include "analysis/output/chart.h"

#include <gmock/gmock.h>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "tests/support/file_size_limit.h"
#include "tests/support/temporary_folder.h"

namespace osteomill::study {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(Chart, IsDrawnByItsScriptWithTheFolder) {
    const testing::TemporaryFolder folder;
    std::ofstream(folder / "dots.gp") << "set terminal svg\nset output folder.'/dots.svg'\n"
                                         "plot folder.'/dots.csv' using 1:2\n";
    std::ofstream(folder / "dots.csv") << "1 2\n3 4\n";
    draw_chart(folder.path(), "dots", folder.path());
    std::ostringstream svg;
    svg << std::ifstream(folder / "dots.svg").rdbuf();
    EXPECT_THAT(svg.str(), HasSubstr("</svg>"));
}

TEST(Chart, SaysInOneLineWhyThereIsNone) {
    const testing::TemporaryFolder folder;
    const auto refusal = [&](const std::string& name) -> std::string {
        try {
            draw_chart(folder.path(), name, folder.path());
        } catch (const std::runtime_error& error) {
            return error.what();
        }
        return "drawn";
    };
    EXPECT_THAT(refusal("missing"), HasSubstr("missing.gp: is not there"));
    std::ofstream(folder / "bad.gp") << "plot 1 +\n";
    EXPECT_THAT(refusal("bad"), AllOf(HasSubstr("bad.gp: gnuplot failed"), HasSubstr("line 1")));
}

TEST(Chart, OfWhichAFullDiskHasNoRoomIsNone) {
    const testing::TemporaryFolder folder;
    std::ofstream(folder / "dots.gp") << "set terminal svg\nset output folder.'/dots.svg'\nplot sin(x)\n";
    const testing::FileSizeLimit disk(1000);
    try {
        draw_chart(folder.path(), "dots", folder.path());
        FAIL() << "drawn";
    } catch (const std::runtime_error& error) {
        EXPECT_THAT(error.what(), HasSubstr("dots.svg: gnuplot could not write all of it"));
    }
    EXPECT_FALSE(std::filesystem::exists(folder / "dots.svg"));
}

TEST(Chart, HasScriptsOfItsOwn) {
    EXPECT_TRUE(std::filesystem::exists(chart_scripts() / "sites.gp"));
}

TEST(Chart, FindsItsScriptsWhereTheProgramIsInstalled) {
    const testing::TemporaryFolder folder;
    const auto refusal = [&]() -> std::string {
        try {
            folder_with_scripts(folder / "installed", folder / "sources");
        } catch (const std::runtime_error& error) {
            return error.what();
        }
        return "found";
    };
    EXPECT_THAT(refusal(), AllOf(HasSubstr("installed"), HasSubstr("sources")));
    std::filesystem::create_directory(folder / "installed");
    EXPECT_THAT(refusal(), HasSubstr("neither")) << "an empty folder";
    std::filesystem::create_directory(folder / "sources");
    std::ofstream(folder / "sources" / "style.gp") << '\n';
    EXPECT_EQ(folder_with_scripts(folder / "installed", folder / "sources"), folder / "sources");
    std::ofstream(folder / "installed" / "style.gp") << '\n';
    EXPECT_EQ(folder_with_scripts(folder / "installed", folder / "sources"), folder / "installed");
}

TEST(Chart, IsMissedBeforeTheWorkNotAfterIt) {
    require_charts();
    const std::string path = std::getenv("PATH");
    ::setenv("PATH", "/nowhere", 1);
    EXPECT_THROW(require_charts(), std::runtime_error) << "no gnuplot";
    ::setenv("PATH", path.c_str(), 1);
}

}  // namespace
}  // namespace osteomill::study
