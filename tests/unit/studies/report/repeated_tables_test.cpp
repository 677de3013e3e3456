#include "analysis/output/repeated/repeated_tables.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <stdexcept>
#include <string>

#include "analysis/output/output_files.h"
#include "analysis/output/table.h"
#include "tests/support/temporary_folder.h"

namespace osteomill::study {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

class RepeatedTablesTest : public ::testing::Test {
  protected:
    RepeatedTablesTest() {
        for (const char* const folder : {"kept", "once", "again"}) make_folder(folder_ / folder);
    }
    /// A table of one case, which is a text, a count and a time.
    void write(const char* folder, const std::string& name, double force_n, double took_us) {
        Table table({"case", "force_n", "took_us"});
        table.add({name, force_n, took_us});
        table.write(folder_ / folder / "found.csv");
    }
    RepeatedTables compare() const {
        return compare_tables(folder_ / "kept", folder_ / "once", folder_ / "again");
    }

    testing::TemporaryFolder folder_;
};

TEST_F(RepeatedTablesTest, AreComparedExactlyWhereBothRunsAreEqual) {
    write("kept", "a, \"b\"", 1.5, 10.0);
    write("once", "a, \"b\"", 1.5, 10.0);
    write("again", "a, \"b\"", 1.5, 10.0);
    EXPECT_EQ(compare().columns, 3U);
    EXPECT_THAT(compare().different, IsEmpty());
    write("kept", "another", 1.501, 10.0);
    const RepeatedTables tables = compare();
    ASSERT_EQ(tables.different.size(), 2U);
    EXPECT_EQ(tables.different[0].name, "found.csv: case");
    EXPECT_EQ(tables.different[1].name, "found.csv: force_n");
    EXPECT_NEAR(tables.different[1].difference, 0.001, 1e-12);
    EXPECT_EQ(tables.different[1].noise, 0.0);
}

TEST_F(RepeatedTablesTest, MayDifferByTwiceTheNoiseOfTheTwoRuns) {
    write("once", "a", 1.0, 10.0);
    write("again", "a", 1.0, 11.0);
    write("kept", "a", 1.0, 12.9);  // 1.9 from the nearer of them
    EXPECT_THAT(compare().different, IsEmpty());
    write("kept", "a", 1.0, 13.1);
    ASSERT_EQ(compare().different.size(), 1U);
    EXPECT_EQ(compare().different[0].noise, 1.0);
}

TEST_F(RepeatedTablesTest, MayBeJson) {
    for (const char* const folder : {"kept", "once", "again"})
        write_json({{"bars", {{{"worst", 1.5}}, {{"worst", 2.5}}}}}, folder_ / folder / "found.json");
    EXPECT_EQ(compare().columns, 1U);
    EXPECT_THAT(compare().different, IsEmpty());
    write_json({{"bars", {{{"worst", 1.5}}, {{"worst", 2.75}}}}}, folder_ / "kept/found.json");
    ASSERT_EQ(compare().different.size(), 1U);
    EXPECT_EQ(compare().different[0].name, "found.json: /bars/*/worst");
    EXPECT_EQ(compare().different[0].differ, 1U);
    EXPECT_EQ(compare().different[0].difference, 0.25);
    write_text("{", folder_ / "once/found.json");
    EXPECT_THROW(compare(), std::runtime_error);
}

TEST_F(RepeatedTablesTest, OfOtherShapesAreNamed) {
    write("kept", "a", 1.0, 10.0);
    write("once", "a", 1.0, 10.0);
    EXPECT_THAT(compare().other, ElementsAre("found.csv: is not written any more"));
    write_text("case,force_n\na,1\n", folder_ / "again/found.csv");
    EXPECT_THAT(compare().other, ElementsAre("found.csv: has other rows or columns"));
}

}  // namespace
}  // namespace osteomill::study
