#include <gtest/gtest.h>

#include "imaging/formats/plausible_geometry.h"

namespace osteomill {
namespace {

TEST(LengthUnit, IsKnownInEverySpelling) {
    for (const char* name : {"mm", "MM", "millimeter", "Millimeters", "millimetres"})
        EXPECT_EQ(mm_of_unit(name), 1.0) << name;
    for (const char* name : {"um", "\xc2\xb5m", "\xce\xbcm", "\xb5m", "micron", "microns", "Micrometers"})
        EXPECT_EQ(mm_of_unit(name), 1e-3) << name;
    EXPECT_EQ(mm_of_unit("cm"), 10.0);
    EXPECT_EQ(mm_of_unit(" m "), 1000.0);
    EXPECT_EQ(mm_of_unit("nm"), 1e-6);
    for (const char* name : {"s", "ms", "mms", "furlong", ""}) EXPECT_FALSE(mm_of_unit(name)) << name;
}

TEST(LengthUnit, MayBeUnknown) {
    for (const char* name : {"", "?", "???", "None", "unknown"}) EXPECT_TRUE(is_unknown_unit(name)) << name;
    EXPECT_FALSE(is_unknown_unit("mm"));
}

}  // namespace
}  // namespace osteomill
