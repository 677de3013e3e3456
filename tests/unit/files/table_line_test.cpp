#include "common/files/table_line.h"

#include <gtest/gtest.h>

#include <sstream>
#include <vector>

namespace osteomill {
namespace {

std::vector<std::string> lines_of(const std::string& text) {
    std::istringstream in(text);
    std::vector<std::string> lines;
    std::size_t number = 0;
    for (std::string line; next_table_line(in, line, number);) lines.push_back(line);
    EXPECT_EQ(number, lines.size());
    return lines;
}

TEST(TableLine, IsTheSameHoweverASpreadsheetSavedIt) {
    const std::vector<std::string> plain{"a,b", "# c; d", "0.5,1"};
    EXPECT_EQ(lines_of("a,b\n# c; d\n0.5,1\n"), plain);
    EXPECT_EQ(lines_of("\xef\xbb\xbf"
                       "a;b\r\n# c; d\r\n0.5;1"),
              plain);
}

TEST(TableLine, IsRefusedByNameWhereItCannotBeRead) {
    EXPECT_THROW(lines_of("a;b\n0,5;1\n"), std::runtime_error);
    for (const char* text : {"\xff\xfe;", "\xfe\xff;"}) EXPECT_THROW(lines_of(text), std::runtime_error);
}

}  // namespace
}  // namespace osteomill
