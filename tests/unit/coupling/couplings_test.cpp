#include "simulation/coupling/couplings.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace osteomill::couplings_test {
namespace {

TEST(Coupling, EveryNameMakesOneAndTheDefaultIsImplicit) {
    EXPECT_EQ(coupling_names().front(), "implicit");
    for (const std::string& name : coupling_names()) EXPECT_NE(make_coupling(name, {}), nullptr);
}

TEST(Coupling, ADirectOneTakesADamperOrPassivity) {
    for (const char* base : {"hold", "interpolate", "sample-estimate-hold", "corrected-sample-estimate-hold",
                             "sample-estimate-interpolate"})
        for (const char* addition : {"+damper", "+passivity"})
            EXPECT_NE(make_coupling(std::string(base) + addition, {}), nullptr);
}

TEST(Coupling, AnUnknownNameIsRefusedInOneLineWithTheChoices) {
    for (const char* name : {"glue", "", "hold+", "+damper", "hold+glue", "implicit+damper", "damper+damper",
                             "hold+damper+passivity", "Hold"}) {
        try {
            (void)make_coupling(name, {});
            FAIL() << "took " << name;
        } catch (const std::invalid_argument& error) {
            const std::string what = error.what();
            for (const std::string& known : coupling_names()) EXPECT_NE(what.find(known), std::string::npos);
            EXPECT_NE(what.find("+passivity"), std::string::npos);
            EXPECT_EQ(what.find('\n'), std::string::npos);
        }
    }
}

TEST(Coupling, IsInterpolatedWhereItsForceIsALine) {
    for (const char* name : {"interpolate", "sample-estimate-interpolate", "interpolate+damper"})
        EXPECT_TRUE(find_coupling(name).is_interpolated) << name;
    for (const char* name : {"implicit", "hold", "sample-estimate-hold+passivity", "virtual-coupling"})
        EXPECT_FALSE(find_coupling(name).is_interpolated) << name;
}

TEST(Coupling, ThatSolvesTheCuttingLawIsRefusedWhereThereIsNone) {
    EXPECT_THROW((void)make_coupling("implicit", {.device = {}, .model_holds_wall = true}),
                 std::invalid_argument);
    for (const CouplingEntry& coupling : couplings()) {
        if (coupling.needs_cutting_law) continue;
        EXPECT_NE(make_coupling(coupling.name, {.device = {}, .model_holds_wall = true}), nullptr);
    }
}

}  // namespace
}  // namespace osteomill::couplings_test
