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

TEST(Materials, AreThoseOfSegmentsByTheirNames) {
    const auto of = [](const char* name) {
        const Material* material = material_of_segment(name);
        return material == nullptr ? std::string("none") : material->name;
    };
    for (const char* name : {"Bone", "Temporal bone", "vertebrae_L1", "rib_left_12", "Malleus",
                             "Bony_Labyrinth", "Maxilla & Upper Skull", "femur_right", "LeftMandible"})
        EXPECT_EQ(of(name), "cortical bone") << name;
    for (const char* name : {"Upper Teeth", "teeth_lower", "Tooth 36", "dentine"})
        EXPECT_EQ(of(name), "dentine") << name;
    EXPECT_EQ(of("tooth_enamel"), "enamel");
    EXPECT_EQ(of("trabecular bone"), "trabecular bone");
    for (const char* name :
         {"Facial_Nerve", "Mandibular canal", "inferior_alveolar_canal_left", "ICA", "Sinus_+_Dura",
          "bone marrow", "costal_cartilages", "TMJ", "EAC", "IAC", "Tumour", "", "boneless"})
        EXPECT_EQ(of(name), "none") << name;
}

}  // namespace
}  // namespace osteomill
