#include "analysis/output/table.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace osteomill::study {
namespace {

TEST(Table, IsCsvWithAHeaderAndJsonByColumn) {
    Table table({"name", "count", "share", "holds", "depth_mm"});
    table.add({"one, two", 3, 1.0 / 3.0, true, or_empty(std::optional<double>{})});
    table.add({"b", -1, std::numeric_limits<double>::quiet_NaN(), false, or_empty(std::optional(0.25))});
    EXPECT_EQ(table.csv(),
              "name,count,share,holds,depth_mm\n"
              "\"one, two\",3,0.333333,1,\n"
              "b,-1,nan,0,0.25\n");
    EXPECT_EQ(table.json().at(0).at("count"), 3);
    EXPECT_EQ(table.json().at(1).at("holds"), false);
    EXPECT_EQ(table.json().at(1).at("share").dump(), "null");
    EXPECT_EQ(Table({"a"}).csv(), "a\n");
    EXPECT_THROW(table.add({"too short"}), std::logic_error);
}

}  // namespace
}  // namespace osteomill::study
