#include "common/scene/material.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/scene/stiffness_relation.h"

namespace osteomill {
namespace {

TEST(Materials, AreThoseThatALabMills) {
    const auto has = [](const std::string& name) {
        return std::any_of(shipped_materials().begin(), shipped_materials().end(),
                           [&](const Material& material) { return material.name == name; });
    };
    for (const char* name : {"cortical bone", "trabecular bone", "enamel", "dentine", "sawbones 20 pcf"})
        EXPECT_TRUE(has(name)) << name;
}

TEST(Materials, AreStrengthsBesideThePublishedBone) {
    const Material& bone = shipped_materials().front();
    EXPECT_EQ(bone.name, "cortical bone");
    EXPECT_EQ(bone.cutting_n_per_mm2, 230.0);
    EXPECT_EQ(bone.relative_stiffness, 1.0);
    EXPECT_EQ(bone.relative_edge, 1.0);
    for (const Material& material : shipped_materials()) {
        EXPECT_NEAR(material.relative_stiffness * 230.0, material.cutting_n_per_mm2, 1e-9) << material.name;
        EXPECT_LE(material.relative_stiffness, largest_relative_stiffness) << material.name;
        EXPECT_GT(material.relative_edge, 0.0) << material.name;
    }
}

}  // namespace
}  // namespace osteomill
