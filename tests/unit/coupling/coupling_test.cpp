#include "haptic_server/coupling/coupling.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace osteomill {
namespace {

TEST(Coupling, EveryNameMakesOneAndTheDefaultIsImplicit) {
    EXPECT_EQ(coupling_names().front(), "implicit");
    for (const std::string& name : coupling_names()) EXPECT_NE(make_coupling(name, {}), nullptr);
}

TEST(Coupling, AnUnknownNameIsRefusedWithTheChoices) {
    try {
        (void)make_coupling("glue", {});
        FAIL() << "took it";
    } catch (const std::invalid_argument& error) {
        for (const std::string& name : coupling_names())
            EXPECT_NE(std::string(error.what()).find(name), std::string::npos);
    }
}

TEST(Coupling, ThatSolvesTheCuttingLawIsRefusedWhereThereIsNone) {
    EXPECT_THROW((void)make_coupling("implicit", {.device = {}, .model_holds_wall = true}),
                 std::invalid_argument);
    EXPECT_NE(make_coupling("interpolate", {.device = {}, .model_holds_wall = true}), nullptr);
}

}  // namespace
}  // namespace osteomill
