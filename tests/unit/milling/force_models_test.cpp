#include "haptic_server/milling/force_models.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/block.h"

namespace osteomill {
namespace {

using ::testing::HasSubstr;
using testing::make_block;

Bone block() {
    return make_block({-2.0, -2.0, -2.0}, {2.0, 2.0, 0.0}, 0.2);
}

TEST(ForceModels, AreMadeByEachOfTheirNames) {
    for (const std::string& name : force_model_names()) {
        const auto model = make_contact_model(name, block(), {Burr{}}, {});
        ASSERT_NE(model, nullptr) << name;
        EXPECT_EQ(checksum(model->bone()), checksum(block())) << name;
        EXPECT_EQ(model->removed_mm3(), RemovedByTissue{}) << name;
    }
}

TEST(ForceModels, RefuseAnUnknownNameAndListTheKnownOnes) {
    try {
        (void)make_contact_model("wishful", block(), {Burr{}}, {});
        FAIL() << "it was taken";
    } catch (const std::invalid_argument& error) {
        EXPECT_THAT(error.what(), HasSubstr("'wishful'"));
        for (const std::string& name : force_model_names()) EXPECT_THAT(error.what(), HasSubstr(name));
    }
}

TEST(ForceModels, RefuseABurrThatCannotCut) {
    for (const std::string& name : force_model_names()) {
        EXPECT_THROW((void)make_contact_model(name, block(), {}, {}), std::invalid_argument) << name;
        EXPECT_THROW((void)make_contact_model(name, block(), {Burr{.diameter_mm = 0.0}}, {}),
                     std::invalid_argument)
            << name;
    }
}

}  // namespace
}  // namespace osteomill
