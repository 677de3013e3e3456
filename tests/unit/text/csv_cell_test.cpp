#include <gtest/gtest.h>

#include "common/text/csv.h"

namespace osteomill {
namespace {

TEST(CsvCell, LeavesPlainTextAlone) {
    EXPECT_EQ(csv_cell(""), "");
    EXPECT_EQ(csv_cell("1.5 mm"), "1.5 mm");
    EXPECT_EQ(csv_cell("Z\u00e4hne"), "Z\u00e4hne");
    EXPECT_EQ(csv_cell("a=b"), "a=b");
}

TEST(CsvCell, QuotesWhatASeparatorWouldEnd) {
    EXPECT_EQ(csv_cell("a,b"), "\"a,b\"");
    EXPECT_EQ(csv_cell("say \"no\""), "\"say \"\"no\"\"\"");
    EXPECT_EQ(csv_cell(" a"), "\" a\"");
    EXPECT_EQ(csv_cell("a\nb"), "a\\x0ab");
}

TEST(CsvCell, IsTextWhereASpreadsheetWouldComputeIt) {
    for (const char* formula : {"=1+1", "+1", "-nerve", "@SUM(A1)", " =1", "\t=1", "\r=1"}) {
        const std::string cell = csv_cell(formula);
        EXPECT_TRUE(cell.starts_with("\"'")) << cell;
        EXPECT_TRUE(cell.ends_with('"')) << cell;
    }
    EXPECT_EQ(csv_cell("=HYPERLINK(\"x\")"), "\"'=HYPERLINK(\"\"x\"\")\"");
}

TEST(Utf8Mark, IsWhereATableHoldsMoreThanAscii) {
    EXPECT_EQ(with_utf8_mark("a,b\n"), "a,b\n");
    EXPECT_EQ(with_utf8_mark("J\xc3\xbcrgen\n"), "\xef\xbb\xbfJ\xc3\xbcrgen\n");
}

}  // namespace
}  // namespace osteomill
