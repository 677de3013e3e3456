#include "render_client/ui/view/bone_on_screen.h"

#include "studies/render/made_bone.h"
#include "tests/unit/volume/offscreen_test.h"

namespace osteomill::bone_on_screen_test {
namespace {

Bone ball(double radius_mm) {
    const Grid grid{.size_voxels = {90, 90, 90}, .origin_mm = glm::dvec3(-4.45)};
    return made_bone(grid, [&](const glm::dvec3& p) { return radius_mm - glm::length(p); });
}

bool never() {
    return false;
}
bool always() {
    return true;
}

std::vector<std::uint8_t> fractions(const BoneTextures& textures) {
    std::vector<std::uint8_t> bytes(VoxelBox{{}, textures.fraction().size()}.count());
    textures.fraction().read_back(bytes);
    return bytes;
}

class BoneOnScreenTest : public OffscreenTest {
  protected:
    void SetUp() override {
        OffscreenTest::SetUp();
        if (!IsSkipped()) screen_.emplace(ShadingSettings{});
    }
    void TearDown() override {
        screen_.reset();
        OffscreenTest::TearDown();
    }
    bool shows(const Bone& bone) const {
        return screen_->textures() != nullptr &&
               fractions(*screen_->textures()) == fractions(BoneTextures(bone, {}));
    }

    std::optional<BoneOnScreen> screen_;
};

const ShadingSettings see_through{.transfer = transfer_presets()[1]};

TEST_F(BoneOnScreenTest, PreparesABoneAStepACallWhereThereIsNoTime) {
    const Bone bone = ball(2.0);
    screen_->replace(bone, {});
    EXPECT_EQ(screen_->preparation(), 0.0);
    int calls = 0;
    while (!screen_->work(bone, never).other_textures) {
        ++calls;
        EXPECT_EQ(screen_->textures(), nullptr);
        EXPECT_TRUE(screen_->preparation());
    }
    EXPECT_GT(calls, 10);
    EXPECT_FALSE(screen_->preparation());
    EXPECT_TRUE(shows(bone));
}

TEST_F(BoneOnScreenTest, ShowsWhatWasCarvedWhileItPrepared) {
    Bone bone = ball(2.0);
    screen_->replace(bone, {});
    for (int call = 0; call < 20; ++call) screen_->work(bone, never);
    screen_->note(carve_sphere(bone, {1.5, 0.0, 0.0}, 1.0));
    const auto outcome = screen_->work(bone, always);
    EXPECT_TRUE(outcome.other_textures);
    EXPECT_TRUE(shows(bone));
}

TEST_F(BoneOnScreenTest, GoesOnShowingAndCarvingOneLookWhileAnotherIsPrepared) {
    Bone bone = ball(2.0);
    screen_->replace(bone, {});
    screen_->work(bone, always);
    screen_->set_appearance(see_through);
    const BoneTextures* before = screen_->textures();
    screen_->work(bone, never);
    screen_->note(carve_sphere(bone, {1.5, 0.0, 0.0}, 1.0));
    EXPECT_FALSE(screen_->work(bone, never).changed.empty());
    EXPECT_EQ(screen_->textures(), before);
    EXPECT_TRUE(shows(bone)) << "the look before, carved";
    EXPECT_TRUE(screen_->work(bone, always).other_textures);
    EXPECT_FALSE(screen_->preparation());
    EXPECT_EQ(fractions(*screen_->textures()), fractions(BoneTextures(bone, {}, see_through)));
}

TEST_F(BoneOnScreenTest, FinishesALookBeforeItBeginsTheNextAndEndsWithTheLast) {
    const Bone bone = ball(2.0);
    screen_->replace(bone, {});
    screen_->work(bone, always);
    int shown = 0;
    for (const int preset : {1, 2}) {
        screen_->set_appearance({.transfer = transfer_presets()[static_cast<std::size_t>(preset)]});
        shown += screen_->work(bone, never).other_textures ? 1 : 0;
    }
    for (int call = 0; call < 10'000 && screen_->preparation(); ++call)
        shown += screen_->work(bone, never).other_textures ? 1 : 0;
    EXPECT_EQ(shown, 2);
    EXPECT_EQ(screen_->look(), (ShadingSettings{.transfer = transfer_presets()[2]}));
    EXPECT_FALSE(screen_->preparation());
}

TEST_F(BoneOnScreenTest, DropsTheBoneBeforeOnlyWhereBothDoNotFit) {
    const Bone first = ball(2.0), second = first;
    const ShadingSettings published{.shading = Shading::surface_voxels};
    const std::size_t bytes = BoneTextures(first, {}, published).plan().bytes;
    for (const bool both_fit : {true, false}) {
        screen_.emplace(published);
        screen_->limit({.budget_bytes = both_fit ? 2 * bytes : 2 * bytes - 1});
        screen_->replace(first, {});
        screen_->work(first, always);
        ASSERT_NE(screen_->textures(), nullptr);
        screen_->replace(second, {});
        for (int call = 0; call < 20; ++call) screen_->work(second, never);
        ASSERT_TRUE(screen_->preparation());
        EXPECT_EQ(screen_->textures() != nullptr, both_fit);
        screen_->work(second, always);
        EXPECT_NE(screen_->textures(), nullptr);
    }
}

TEST_F(BoneOnScreenTest, BeginsAnewWithABoneThatComesBeforeTheLastOneIsReady) {
    const Bone second = ball(1.2);
    {
        Bone first = ball(2.0);
        screen_->replace(first, {});
        for (int call = 0; call < 20; ++call) screen_->work(first, never);
        screen_->note(carve_sphere(first, {1.5, 0.0, 0.0}, 1.0));
        screen_->replace(second, {});
    }
    EXPECT_TRUE(screen_->work(second, always).other_textures);
    EXPECT_TRUE(shows(second));
}

TEST_F(BoneOnScreenTest, UploadsManyChangesInPartsWhereThereIsNoTime) {
    Bone bone = ball(4.0);
    screen_->replace(bone, {});
    screen_->work(bone, always);
    const auto changes = carve_sphere(bone, {0.0, 0.0, 0.0}, 3.9);
    ASSERT_GT(changes.size(), 64U) << "more than one part";
    screen_->note(changes);
    int calls = 0;
    while (!shows(bone) && ++calls < 10) EXPECT_FALSE(screen_->work(bone, never).changed.empty());
    EXPECT_GT(calls, 1);
    EXPECT_TRUE(screen_->work(bone, never).changed.empty());
}

TEST_F(BoneOnScreenTest, SaysWhyABoneCannotBeDrawnAndShowsTheNext) {
    const Bone bone = ball(2.0);
    screen_->limit({.budget_bytes = 1000});
    screen_->replace(bone, {});
    EXPECT_TRUE(screen_->work(bone, always).other_textures) << "the problem is to be shown";
    EXPECT_NE(screen_->problem().find("exceed the graphics memory"), std::string::npos) << screen_->problem();
    EXPECT_FALSE(screen_->preparation());
    EXPECT_FALSE(screen_->work(bone, always).is_news()) << "it is not tried again";
    screen_->limit({});
    screen_->replace(bone, {});
    screen_->work(bone, always);
    EXPECT_EQ(screen_->problem(), "");
    EXPECT_TRUE(shows(bone));
}

}  // namespace
}  // namespace osteomill::bone_on_screen_test
