#include "simulation/force_models/force_models.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <stdexcept>

#include "tests/support/block.h"

namespace osteomill::force_models_test {
namespace {

using ::testing::HasSubstr;
using testing::make_block;

Bone block() {
    return make_block({-2.0, -2.0, -2.0}, {2.0, 2.0, 0.0}, 0.2);
}

TEST(ForceModels, AreMadeByEachOfTheirNames) {
    for (const std::string& name : force_model_names()) {
        const auto model = make_force_model(name, block(), {Burr{}}, {});
        ASSERT_NE(model, nullptr) << name;
        EXPECT_EQ(checksum(model->bone()), checksum(block())) << name;
        EXPECT_EQ(model->removed_mm3(), RemovedByTissue{}) << name;
    }
}

TEST(ForceModels, RefuseAnUnknownNameAndListTheKnownOnes) {
    try {
        (void)make_force_model("wishful", block(), {Burr{}}, {});
        FAIL() << "it was taken";
    } catch (const std::invalid_argument& error) {
        EXPECT_THAT(error.what(), HasSubstr("'wishful'"));
        for (const std::string& name : force_model_names()) EXPECT_THAT(error.what(), HasSubstr(name));
    }
}

TEST(ForceModels, SayWhetherACouplingCanSolveThem) {
    ForgottenChanges changes;
    const auto result = std::make_unique<MillingResult>();
    for (const ForceModelEntry& listed : force_models()) {
        EXPECT_EQ(find_force_model(listed.name).has_cutting_law, listed.has_cutting_law);
        const auto model = make_force_model(listed.name, block(), {Burr{.diameter_mm = 2.0}}, {});
        model->step({.pose = {{0.0, 0.0, 0.7}, {0.0, 0.0, 1.0}}, .elapsed_s = 0.001}, 0.0, changes, *result);
        EXPECT_EQ(result->engagement.count > 0, listed.has_cutting_law) << listed.name;
        EXPECT_EQ(result->force_n == glm::dvec3(0.0), listed.has_cutting_law)
            << listed.name << ": with the spindle off the wall is either the coupling's or the model's";
    }
}

TEST(ForceModels, RefuseABurrThatCannotCut) {
    for (const std::string& name : force_model_names()) {
        EXPECT_THROW((void)make_force_model(name, block(), {}, {}), std::invalid_argument) << name;
        EXPECT_THROW((void)make_force_model(name, block(), {Burr{.diameter_mm = 0.0}}, {}),
                     std::invalid_argument)
            << name;
    }
}

}  // namespace
}  // namespace osteomill::force_models_test
