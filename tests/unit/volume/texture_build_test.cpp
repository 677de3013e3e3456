#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <numeric>

#include "render_client/volume/textures/bone_textures.h"
#include "studies/render/made_bone.h"
#include "tests/unit/volume/offscreen_test.h"

namespace osteomill::texture_build_test {
namespace {

const Grid grid{.size_voxels = {90, 70, 50}, .origin_mm = {0.05, 0.05, 0.05}};

std::vector<TissueColour> tissues_of(double opacity) {
    return {{3, {200, 180, 150}, 1.0}, {4, {240, 240, 230}, opacity}};
}
const std::vector<TissueColour> tissues = tissues_of(0.5);

Bone ball() {
    return made_bone(
        grid, [](const glm::dvec3& p) { return 1.9 - glm::length(p - glm::dvec3(5.0, 4.0, 2.5)); },
        [](const glm::dvec3& p) { return static_cast<std::uint8_t>(p.z > 2.0 ? 3 : 4); });
}

Bone plain_ball() {
    return made_bone(grid,
                     [](const glm::dvec3& p) { return 1.9 - glm::length(p - glm::dvec3(5.0, 4.0, 2.5)); });
}

using Texels = std::vector<std::uint8_t>;

Texels texels(const gl::Texture3D* texture, std::size_t bytes_per_texel = 1) {
    if (texture == nullptr) return {};
    Texels bytes(bytes_per_texel * VoxelBox{{}, texture->size()}.count());
    texture->read_back(bytes);
    return bytes;
}

/// All of the textures but the distances of empty space, which may be shorter after a carve than they must
/// be.
std::vector<Texels> content_of(const BoneTextures& textures) {
    std::vector<Texels> all{texels(&textures.fraction()), texels(textures.smoothed()),
                            texels(textures.surface_colours(), 4)};
    if (textures.colour_code()) all.push_back(texels(&*textures.colour_code()));
    if (textures.tile_table()) all.push_back(texels(&*textures.tile_table(), 4));
    const Texels pairs = texels(&textures.blocks(), 2);
    Texels& means = all.emplace_back();
    for (std::size_t block = 0; block < pairs.size(); block += 2) means.push_back(pairs[block]);
    return all;
}

/// Which texture differs, in how many bytes and in which at first; empty if none does.
std::string first_difference(const std::vector<Texels>& are, const std::vector<Texels>& would_be) {
    for (std::size_t texture = 0; texture < would_be.size(); ++texture) {
        const auto [at, other] = std::ranges::mismatch(are[texture], would_be[texture]);
        if (at == are[texture].end()) continue;
        const auto differ =
            std::inner_product(at, are[texture].end(), other, 0, std::plus<>(), std::not_equal_to<>());
        return fmt::format("texture {}: {} of {} bytes differ, first {}: {} for {}", texture, differ,
                           are[texture].size(), at - are[texture].begin(), *at, *other);
    }
    return "";
}

bool no_distance_is_longer(const BoneTextures& textures, const BoneTextures& fresh) {
    const Texels are = texels(&textures.blocks(), 2), would_be = texels(&fresh.blocks(), 2);
    for (std::size_t block = 1; block < are.size(); block += 2)
        if (are[block] > would_be[block]) return false;
    return true;
}

int steps_of(const Bone& bone, const std::vector<TissueColour>& colours, const ShadingSettings& look,
             const TextureLimits& limits) {
    TextureBuild build(bone, colours, look, limits);
    int steps = 1;
    while (build.step()) ++steps;
    return steps;
}

struct Held {
    const char* name;
    ShadingSettings look{};
    TextureLimits limits{};
    bool is_labelled = true;
    double opacity = 0.5;  ///< one of two tissues'
};

class HeldEachWay : public OffscreenTest, public ::testing::WithParamInterface<Held> {
  protected:
    Bone bone() const { return GetParam().is_labelled ? ball() : plain_ball(); }
};

TEST_P(HeldEachWay, ABoneThatIsCarvedBetweenStepsComesOutAsOneThatWasCarvedBefore) {
    const auto& [name, look, limits, is_labelled, opacity] = GetParam();
    const std::vector<TissueColour> colours = tissues_of(opacity);
    const int steps = steps_of(bone(), colours, look, limits);
    ASSERT_GT(steps, 20);
    for (const int carved_after : {1, steps / 4, steps / 2, 3 * steps / 4, steps - 2}) {
        Bone carved = bone();
        TextureBuild build(carved, colours, look, limits);
        for (int step = 0; step < carved_after; ++step) ASSERT_TRUE(build.step());
        const auto changes = carve_sphere(carved, {4.2, 3.5, 4.0}, 1.1);
        ASSERT_FALSE(changes.empty());
        BoneTextures textures = build.all_at_once();
        textures.update(carved, changes);
        const BoneTextures fresh = TextureBuild(carved, colours, look, limits).all_at_once();
        EXPECT_EQ(first_difference(content_of(textures), content_of(fresh)), "")
            << name << ", carved after " << carved_after;
        EXPECT_TRUE(no_distance_is_longer(textures, fresh)) << name << ", carved after " << carved_after;
    }
}

INSTANTIATE_TEST_SUITE_P(
    TextureBuild, HeldEachWay,
    ::testing::Values(
        Held{"dense", {}, {.layout = BoneLayout::dense}}, Held{"atlas", {}, {.layout = BoneLayout::atlas}},
        Held{"surface voxels", {.shading = Shading::surface_voxels}, {.layout = BoneLayout::atlas}},
        Held{"partly hidden", {}, {.layout = BoneLayout::dense}, true, 0.0},
        // A budget that is too small for the bone itself leaves a coarser copy, whose codes are not
        // made again.
        Held{"coarse", {}, {.budget_bytes = 30'000, .layout = BoneLayout::dense}, false}));

using TextureBuildTest = OffscreenTest;

TEST_F(TextureBuildTest, TellsHowItWillHoldTheBoneAndHowFarItIs) {
    const Bone bone = ball();
    TextureBuild build(bone, tissues, {}, {});
    EXPECT_FALSE(build.plan());
    double before = 0.0;
    while (build.step()) {
        EXPECT_GE(build.done(), before);
        before = build.done();
    }
    EXPECT_GT(before, 0.85);
    ASSERT_TRUE(build.plan());
    EXPECT_EQ(build.take().plan(), *build.plan());
    EXPECT_FALSE(build.has_settled_for_less());
}

TEST_F(TextureBuildTest, MakesNothingTranslucentForATissueThatNoBoneBears) {
    const Bone bone = ball();
    const auto is_translucent = [&](std::uint8_t label) {
        return TextureBuild(bone, {{label, {240, 240, 230}, 0.5}}, {}, {}).all_at_once().is_translucent();
    };
    EXPECT_TRUE(is_translucent(4));
    EXPECT_FALSE(is_translucent(9));
}

TEST_F(TextureBuildTest, FailsInItsStepsWhereABoneFitsInNoWay) {
    const Bone bone = ball();
    TextureBuild build(bone, tissues, {}, {.budget_bytes = 1000});
    EXPECT_THROW(build.all_at_once(), std::runtime_error);
    EXPECT_FALSE(build.step());
}

}  // namespace
}  // namespace osteomill::texture_build_test
