#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <glm/common.hpp>
#include <set>

#include "common/bone/bone_builder.h"
#include "render_client/volume/shading_settings.h"

namespace osteomill::tissue_shades_test {
namespace {

/// A brick of bone with a label and a stiffness code by x.
Bone bone_of(const std::function<std::uint8_t(int)>& label,
             const std::function<std::uint8_t(int)>& stiffness) {
    BoneBuilder builder = BoneBuilder::heterogeneous({.size_voxels = glm::ivec3(16)}, 0.02, true);
    ByteBrick fraction{}, stiffnesses{}, labels{};
    fraction.fill(255);
    for (std::size_t offset = 0; offset < brick_voxel_count; ++offset) {
        stiffnesses[offset] = stiffness(voxel_in_brick(offset).x);
        labels[offset] = label(voxel_in_brick(offset).x);
    }
    builder.add_brick({0, 0, 0}, fraction, &stiffnesses, &labels);
    return std::move(builder).build();
}

/// A tooth of dentine and, from x = 8 on, enamel under one label; jaw of one stiffness for x < 2.
Bone segmented_tooth() {
    return bone_of([](int x) { return static_cast<std::uint8_t>(x < 2 ? 2 : 1); },
                   [](int x) {
                       return static_cast<std::uint8_t>(x < 2 ? 40 : x < 8 ? 50 : 110);
                   });
}

const std::array<TissueColour, 2> tissues{{{1, {230, 210, 170}}, {2, {200, 190, 180}, 0.5}}};

glm::vec3 colour_at(const TissueShades& shades, std::uint8_t label, std::uint8_t stiffness) {
    return shades.by_code[shades.codes.by_tissue_and_stiffness[std::size_t{256} * label + stiffness]];
}

TEST(TissueShades, TellEnamelFromDentineWithinATooth) {
    const auto shades = tissue_shades(segmented_tooth().content(), tissues);
    ASSERT_TRUE(shades.has_value());
    const glm::vec3 dentine = colour_at(*shades, 1, 50), enamel = colour_at(*shades, 1, 110);
    EXPECT_GT(enamel.b, 1.1f * dentine.b) << "whiter";
    // Stiffnesses in between have shades in between.
    float blue = dentine.b;
    for (int stiffness = 51; stiffness <= 110; ++stiffness) {
        const float next = colour_at(*shades, 1, static_cast<std::uint8_t>(stiffness)).b;
        EXPECT_GE(next, blue);
        EXPECT_LT(next - blue, 0.1f);
        blue = next;
    }
}

TEST(TissueShades, LeaveATissueOfOneStiffnessItsColour) {
    const auto shades = tissue_shades(segmented_tooth().content(), tissues);
    ASSERT_TRUE(shades.has_value());
    for (const std::uint8_t stiffness : std::initializer_list<std::uint8_t>{1, 40, 200})
        EXPECT_EQ(colour_at(*shades, 2, stiffness), linear_from_srgb({200, 190, 180}));
}

TEST(TissueShades, NeverMixTissues) {
    const auto shades = tissue_shades(segmented_tooth().content(), tissues);
    ASSERT_TRUE(shades.has_value());
    for (const std::uint8_t label : std::initializer_list<std::uint8_t>{1, 2})
        for (std::size_t stiffness = 1; stiffness < 256; ++stiffness) {
            const std::uint8_t code =
                shades->codes.by_tissue_and_stiffness[std::size_t{256} * label + stiffness];
            ASSERT_NE(code, 0);
            ASSERT_EQ(shades->label[code], label);
        }
    EXPECT_EQ(shades->codes.by_tissue_and_stiffness[0], 0) << "no bone";
}

TEST(TissueShades, AreNoneWhereLabelsSayAsMuch) {
    const auto one = [](int) { return std::uint8_t{1}; };
    EXPECT_FALSE(tissue_shades(bone_of(one, [](int) { return std::uint8_t{80}; }).content(), tissues));
    EXPECT_FALSE(tissue_shades(
        bone_of(one, [](int x) { return static_cast<std::uint8_t>(80 + x % 2); }).content(), tissues));
    EXPECT_FALSE(tissue_shades(BoneContent{}, tissues));
}

TEST(TissueShades, HaveRoomForManyTissues) {
    const Bone bone = bone_of([](int x) { return static_cast<std::uint8_t>(10 + x); },
                              [n = 0](int) mutable { return static_cast<std::uint8_t>(50 + n++ % 100); });
    const auto shades = tissue_shades(bone.content(), tissues);
    ASSERT_TRUE(shades.has_value());
    std::set<std::uint8_t> labels;
    for (const std::uint8_t label : shades->label)
        if (label != 0) labels.insert(label);
    EXPECT_EQ(labels.size(), 16u);
    EXPECT_NE(colour_at(*shades, 12, 52), colour_at(*shades, 12, 148));
}

TEST(TissueShades, KeepTheOpacityOfTheirTissue) {
    const Bone bone = segmented_tooth();
    const TransferTable table = transfer_table(bone.content(), tissues, {});
    EXPECT_TRUE(table.codes.are_of_both());
    EXPECT_EQ(table.mode, TransferMode::translucent);
    for (const std::uint8_t stiffness : std::initializer_list<std::uint8_t>{40, 50, 110}) {
        const auto code = [&](std::size_t label) {
            return table.codes.by_tissue_and_stiffness[256 * label + stiffness];
        };
        EXPECT_EQ(table.by_code[code(1)].a, 1.0f);
        EXPECT_EQ(table.by_code[code(2)].a, 0.5f);
    }
}

}  // namespace
}  // namespace osteomill::tissue_shades_test
