// Quality on demand, with made-up times: the test sets the cost of a pixel.
#include "render_client/volume/passes/raycast_renderer.h"
#include "render_client/volume/passes/scene_picture.h"
#include "studies/render/made_bone.h"
#include "tests/unit/volume/offscreen_test.h"

namespace osteomill::speed_on_demand_test {
namespace {

const glm::ivec2 size_px(240, 180);
constexpr std::int64_t all_pixels = 240 * 180;
const Grid grid{.size_voxels = {96, 96, 64}, .origin_mm = {-4.75, -4.75, -3.15}};

/// Counts pixels, and is the stopwatch that makes a time of them.
class PricedRenderer final : public BoneRenderer, public Stopwatch {
  public:
    explicit PricedRenderer(double s_per_px) : s_per_px_(s_per_px) {}

    void draw(const BoneTextures& bone, const Camera& camera, const glm::ivec2& size) override {
        std::array<GLint, 4> scissor{};
        glGetIntegerv(GL_SCISSOR_BOX, scissor.data());
        pixels += static_cast<std::int64_t>(scissor[2]) * scissor[3];
        renderer_.draw(bone, camera, size);
    }
    void start() override { start_pixels_ = pixels; }
    void stop() override { took_s_ = s_per_px_ * static_cast<double>(pixels - start_pixels_); }
    std::optional<double> take_s() override { return std::exchange(took_s_, std::nullopt); }

    std::int64_t pixels = 0;

  private:
    double s_per_px_;
    RaycastRenderer renderer_;
    std::int64_t start_pixels_ = 0;
    std::optional<double> took_s_;
};

class SpeedOnDemand : public OffscreenTest {
  protected:
    void SetUp() override {
        OffscreenTest::SetUp();
        if (IsSkipped()) return;
        bone_.emplace(made_bone(grid, [](const glm::dvec3& p) { return 2.8 - glm::length(p); }));
        textures_.emplace(*bone_, std::span<const TissueColour>());
    }
    void TearDown() override {
        textures_.reset();
        OffscreenTest::TearDown();
    }

    Picture full_picture(const Camera& camera) {
        RaycastRenderer renderer;
        ScenePicture picture(renderer, size_px);
        return picture.draw(&*textures_, nullptr, camera).read_back();
    }
    /// Turns the view until the picture has settled on a resolution.
    void turn(ScenePicture& picture, Camera& camera) {
        for (int frame = 0; frame < 20; ++frame) {
            orbit(camera, 0.02, 0.01);
            picture.draw(&*textures_, nullptr, camera);
        }
    }
    /// The first picture is coarse: its cost is not known yet.
    void refine(ScenePicture& picture) {
        picture.draw(&*textures_, nullptr, camera_);
        for (int frame = 0; frame < 50 && !picture.quality().refined; ++frame)
            picture.draw(&*textures_, nullptr, camera_);
        ASSERT_TRUE(picture.quality().refined);
    }
    void carve(ScenePicture& picture, const glm::dvec3& centre_mm, double radius_mm) {
        const auto changes = carve_sphere(*bone_, centre_mm, radius_mm);
        ASSERT_FALSE(changes.empty());
        picture.mark_dirty(*textures_, textures_->update(*bone_, changes));
    }

    std::optional<Bone> bone_;
    std::optional<BoneTextures> textures_;
    Camera camera_ = camera_on({0.0, 0.0, 0.0}, 5.0);
};

TEST_F(SpeedOnDemand, StaysAtFullQualityWhereThatIsFastEnough) {
    PricedRenderer renderer(0.5 * target_frame_s / all_pixels);
    ScenePicture picture(renderer, size_px, &renderer);
    refine(picture);
    for (int frame = 0; frame < 5; ++frame) {
        orbit(camera_, 0.1, 0.0);
        EXPECT_EQ(picture.draw(&*textures_, nullptr, camera_).read_back(), full_picture(camera_));
        EXPECT_EQ(picture.quality(), PictureQuality{});
    }
}

TEST_F(SpeedOnDemand, DrawsFewerPixelsUnderMotionAndSaysSo) {
    PricedRenderer renderer(4.0 * target_frame_s / all_pixels);
    ScenePicture picture(renderer, size_px, &renderer);
    turn(picture, camera_);
    EXPECT_FALSE(picture.quality().refined);
    EXPECT_NEAR(picture.quality().scale, 0.5, 0.11);
    renderer.pixels = 0;
    orbit(camera_, 0.02, 0.0);
    picture.draw(&*textures_, nullptr, camera_);
    EXPECT_LE(renderer.pixels, 1.1 * all_pixels / 4);
}

TEST_F(SpeedOnDemand, RefinesToThePictureOfFullQualityWithinTheFramesThatItsPixelsNeed) {
    PricedRenderer renderer(4.0 * target_frame_s / all_pixels);
    ScenePicture picture(renderer, size_px, &renderer);
    turn(picture, camera_);
    int frames = 0;
    while (!picture.quality().refined && frames < 20) {
        const std::int64_t before = renderer.pixels;
        picture.draw(&*textures_, nullptr, camera_);
        // No frame takes longer than allowed, three times a moving one's time, except for the tile that began
        // within it.
        EXPECT_LE(renderer.pixels - before, 3 * all_pixels / 4 + tile_edge_px * tile_edge_px);
        ++frames;
    }
    EXPECT_LE(frames, 4);  // two frames of rest, three quarters, the last one
    EXPECT_EQ(picture.draw(&*textures_, nullptr, camera_).read_back(), full_picture(camera_));
}

TEST_F(SpeedOnDemand, ShowsNoSeamBetweenSharpAndCoarsePartsWhileItRefines) {
    PricedRenderer renderer(16.0 * target_frame_s / all_pixels);
    ScenePicture picture(renderer, size_px, &renderer);
    turn(picture, camera_);
    const Picture coarse = picture.draw(&*textures_, nullptr, camera_).read_back();
    const Picture full = full_picture(camera_);
    ASSERT_NE(coarse, full);
    int coarse_frames = 0;
    Picture shown = coarse;
    while (!picture.quality().refined && coarse_frames < 60) {
        shown = picture.draw(&*textures_, nullptr, camera_).read_back();
        if (!picture.quality().refined) {
            EXPECT_EQ(shown, coarse) << coarse_frames;
            ++coarse_frames;
        }
    }
    EXPECT_EQ(shown, full);
    EXPECT_GT(coarse_frames, 3) << "several frames' worth were drawn aside";
}

TEST_F(SpeedOnDemand, TakesACarveIntoPartsThatWereDrawnAside) {
    for (const int frames_before : {3, 4, 5, 6, 8}) {
        PricedRenderer renderer(16.0 * target_frame_s / all_pixels);
        ScenePicture picture(renderer, size_px, &renderer);
        turn(picture, camera_);
        for (int frame = 0; frame < frames_before; ++frame) picture.draw(&*textures_, nullptr, camera_);
        carve(picture, {0.1 * frames_before, -1.0, 2.6}, 0.6);
        for (int frame = 0; frame < 60; ++frame) picture.draw(&*textures_, nullptr, camera_);
        EXPECT_TRUE(picture.quality().refined);
        EXPECT_EQ(picture.draw(&*textures_, nullptr, camera_).read_back(), full_picture(camera_))
            << frames_before;
    }
}

TEST_F(SpeedOnDemand, ShowsTheSameSceneCoarselyAndInPerspective) {
    PricedRenderer renderer(4.0 * target_frame_s / all_pixels);
    ScenePicture picture(renderer, size_px, &renderer);
    turn(picture, camera_);
    orbit(camera_, 0.02, 0.0);
    const gl::Framebuffer& coarse = picture.draw(&*textures_, nullptr, camera_);
    const Picture shown = coarse.read_back();
    const Picture full = full_picture(camera_);
    double squares = 0.0;
    for (std::size_t i = 0; i < full.rgb.size(); ++i) {
        const double difference = static_cast<double>(full.rgb[i]) - shown.rgb[i];
        squares += difference * difference;
    }
    EXPECT_LT(std::sqrt(squares / static_cast<double>(full.rgb.size())), 10.0);
    EXPECT_NE(shown, full);
    EXPECT_LT(coarse.depth_at(size_px / 2), 1.0f);
    EXPECT_EQ(coarse.depth_at({1, 1}), 1.0f);
}

TEST_F(SpeedOnDemand, DrawsASmallCarveExactlyAtOnceHoweverDearTheWholePictureIs) {
    PricedRenderer renderer(4.0 * target_frame_s / all_pixels);
    ScenePicture picture(renderer, size_px, &renderer);
    camera_.distance_mm *= 2.5;
    refine(picture);
    for (const double x : {-0.5, 0.0, 0.5}) {
        carve(picture, {x, -1.0, 2.6}, 0.4);
        const Picture shown = picture.draw(&*textures_, nullptr, camera_).read_back();
        EXPECT_TRUE(picture.quality().refined);
        EXPECT_EQ(shown, full_picture(camera_));
    }
}

TEST_F(SpeedOnDemand, ShowsACarveThatIsTooLargeForAFrameCoarselyAtOnceAndExactlySoon) {
    PricedRenderer renderer(24.0 * target_frame_s / all_pixels);
    ScenePicture picture(renderer, size_px, &renderer);
    Picture before = picture.draw(&*textures_, nullptr, camera_).read_back();
    for (int frame = 0; frame < 4; ++frame) {
        carve(picture, {0.2 * frame, -1.0, 2.4}, 1.2);
        const Picture shown = picture.draw(&*textures_, nullptr, camera_).read_back();
        EXPECT_NE(shown, before);
        EXPECT_FALSE(picture.quality().refined);
        EXPECT_EQ(picture.quality().scale, 0.5);
        before = shown;
    }
    for (int frame = 0; frame < 40 && !picture.quality().refined; ++frame)
        picture.draw(&*textures_, nullptr, camera_);
    EXPECT_EQ(picture.draw(&*textures_, nullptr, camera_).read_back(), full_picture(camera_));
    EXPECT_EQ(picture.quality(), PictureQuality{});
}

TEST_F(SpeedOnDemand, LetsTheAmbientLightNearACarveWaitRatherThanBlurIt) {
    PricedRenderer renderer(6.0 * target_frame_s / all_pixels);
    ScenePicture picture(renderer, size_px, &renderer);
    camera_.distance_mm *= 1.5;
    refine(picture);
    for (int frame = 0; frame < 3; ++frame) {
        const glm::dvec3 centre_mm(0.1 * frame, -1.0, 2.6);
        carve(picture, centre_mm, 0.4);
        const Picture shown = picture.draw(&*textures_, nullptr, camera_).read_back();
        EXPECT_EQ(picture.quality(), (PictureQuality{.scale = 1.0, .refined = false}));
        const Picture full = full_picture(camera_);
        const glm::ivec2 middle(pixel_of(camera_, centre_mm, size_px));
        for (int y = middle.y - 8; y <= middle.y + 8; ++y)
            for (int x = middle.x - 8; x <= middle.x + 8; ++x)
                ASSERT_EQ(shown.at(x, y)[1], full.at(x, y)[1]) << x << ' ' << y;
    }
    for (int frame = 0; frame < 20 && !picture.quality().refined; ++frame)
        picture.draw(&*textures_, nullptr, camera_);
    EXPECT_EQ(picture.draw(&*textures_, nullptr, camera_).read_back(), full_picture(camera_));
}

TEST_F(SpeedOnDemand, StartsAnewWhereTheSizeOrTheBoneChangesInTheMiddleOfRefining) {
    PricedRenderer renderer(8.0 * target_frame_s / all_pixels);
    ScenePicture picture(renderer, {100, 80}, &renderer);
    turn(picture, camera_);
    picture.resize(size_px);
    turn(picture, camera_);
    for (int frame = 0; frame < 4; ++frame) picture.draw(&*textures_, nullptr, camera_);
    picture.forget_bone();
    for (int frame = 0; frame < 20; ++frame) picture.draw(&*textures_, nullptr, camera_);
    EXPECT_EQ(picture.draw(&*textures_, nullptr, camera_).read_back(), full_picture(camera_));
}

}  // namespace
}  // namespace osteomill::speed_on_demand_test
