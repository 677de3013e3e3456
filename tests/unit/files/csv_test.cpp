#include "common/text/csv.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace osteomill {
namespace {

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> found;
    for (TableLines lines(text, "t.csv"); lines.next();) found.push_back(lines.line());
    return found;
}

TEST(TableLine, IsTheSameHoweverASpreadsheetSavedIt) {
    const std::vector<std::string> plain{"a,b", "0.5,1"};
    EXPECT_EQ(lines_of("a,b\n# c; d\n \n0.5,1\n"), plain);
    EXPECT_EQ(lines_of("\xef\xbb\xbf"
                       "a;b\r\n# c; d\r\n0.5;1"),
              plain);
}

TEST(TableLine, IsRefusedByNameWhereItCannotBeRead) {
    try {
        lines_of("a;b\n0,5;1\n");
        FAIL();
    } catch (const std::runtime_error& error) {
        EXPECT_EQ(std::string(error.what()).find("t.csv:2: has semicolons"), 0u) << error.what();
    }
    for (const char* text : {"\xff\xfe;", "\xfe\xff;"}) EXPECT_THROW(lines_of(text), std::runtime_error);
}

}  // namespace
}  // namespace osteomill
