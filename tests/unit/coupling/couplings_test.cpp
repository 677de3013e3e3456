#include "simulation/coupling/couplings.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace osteomill::couplings_test {
namespace {

TEST(Coupling, EveryNameMakesOneAndTheDefaultIsImplicit) {
    EXPECT_EQ(couplings().front().choice, CouplingChoice());
    EXPECT_EQ(couplings().front().name, "implicit");
    for (const CouplingEntry& coupling : couplings()) {
        EXPECT_EQ(coupling_named(coupling.name), coupling.choice) << coupling.name;
        EXPECT_NE(make_coupling(coupling.choice, {}), nullptr) << coupling.name;
    }
}

TEST(Coupling, ADirectOneTakesADamperOrPassivity) {
    for (const char* base : {"hold", "interpolate", "sample-estimate-hold", "corrected-sample-estimate-hold",
                             "sample-estimate-interpolate"})
        for (const char* addition : {"+damper", "+passivity"})
            EXPECT_NE(make_coupling(coupling_named(std::string(base) + addition), {}), nullptr);
}

TEST(Coupling, IsReadAgainFromItsName) {
    for (const char* name : {"implicit", "hold", "interpolate+damper", "sample-estimate-hold+passivity"})
        EXPECT_EQ(name_of(coupling_named(name)), name);
    EXPECT_EQ(name_of(coupling_named("damper")), "hold+damper");
    EXPECT_EQ(name_of(coupling_named("passivity")), "hold+passivity");
}

TEST(Coupling, AnUnknownNameIsRefusedInOneLineWithTheChoices) {
    for (const char* name : {"glue", "", "hold+", "+damper", "hold+glue", "implicit+damper", "damper+damper",
                             "hold+damper+passivity", "Hold"}) {
        try {
            (void)coupling_named(name);
            FAIL() << "took " << name;
        } catch (const std::invalid_argument& error) {
            const std::string what = error.what();
            for (const CouplingEntry& known : couplings())
                EXPECT_NE(what.find(known.name), std::string::npos);
            EXPECT_NE(what.find("+passivity"), std::string::npos);
            EXPECT_EQ(what.find('\n'), std::string::npos);
        }
    }
}

TEST(Coupling, IsInterpolatedWhereItsForceIsALine) {
    for (const char* name : {"interpolate", "sample-estimate-interpolate", "interpolate+damper"})
        EXPECT_TRUE(entry_of(coupling_named(name).kind).is_interpolated) << name;
    for (const char* name : {"implicit", "hold", "sample-estimate-hold+passivity", "virtual-coupling"})
        EXPECT_FALSE(entry_of(coupling_named(name).kind).is_interpolated) << name;
}

TEST(Coupling, ThatSolvesTheCuttingLawIsRefusedWhereThereIsNone) {
    EXPECT_THROW((void)make_coupling({CouplingKind::implicit}, {.device = {}, .model_holds_wall = true}),
                 std::invalid_argument);
    for (const CouplingEntry& coupling : couplings()) {
        if (coupling.needs_cutting_law) continue;
        EXPECT_NE(make_coupling(coupling.choice, {.device = {}, .model_holds_wall = true}), nullptr);
    }
}

}  // namespace
}  // namespace osteomill::couplings_test
