#include "render_client/ui/view/session_picture.h"

#include <array>
#include <set>

#include "render_client/ui/panels/start_panel.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/ui/scripted_session.h"
#include "tests/unit/volume/offscreen_test.h"

namespace osteomill::session_picture_test {
namespace {

const glm::ivec2 size_px(320, 240);
constexpr double frame_s = 1.0 / 30.0;

/// The scripted session, as a link reports it.
class ToldSession final : public SessionSource {
  public:
    LinkUpdate poll() override {
        // A preparation takes thousands of polls. Carving in the first of them is enough.
        LinkUpdate update;
        if (carvings_left_-- > 0) update = session_->poll();
        update.status = status;
        update.silent_s = silent_s;
        if (replaces) update.bone_replaced = std::exchange(replaces, false);
        return update;
    }
    const Bone* bone() const override { return session_->bone(); }
    const SessionInfo* session() const override { return session_->session(); }
    /// Another session comes, from its beginning.
    void begin_anew() {
        session_.emplace(100'000);
        replaces = true;
        carvings_left_ = 20;
    }

    LinkStatus status = LinkStatus::live;
    bool replaces = false;
    double silent_s = 0.0;

  private:
    int carvings_left_ = 20;
    std::optional<ScriptedSession> session_{std::in_place, 100'000};
};

class SessionPictureTest : public OffscreenTest {
  protected:
    void SetUp() override {
        OffscreenTest::SetUp();
        if (IsSkipped()) return;
        panels_.emplace();
        picture_.emplace(session_, *panels_, size_px, FrameQuality::on_demand);
        picture_->prepare_for(std::chrono::milliseconds(0));
    }
    void TearDown() override {
        picture_.reset();
        panels_.reset();
        OffscreenTest::TearDown();
    }
    Picture draw() { return picture_->draw(frame_s).read_back(); }
    void prepare() {
        for (int call = 0; call < 100'000 && picture_->preparation_percent(); ++call) picture_->take_in();
    }

    ToldSession session_;
    std::optional<ImguiContext> panels_;
    std::optional<SessionPicture> picture_;
};

TEST_F(SessionPictureTest, AnswersAndTellsHowFarItIsWhileTheBoneIsPrepared) {
    picture_->take_in();
    ASSERT_EQ(picture_->preparation_percent(), 0);
    draw();
    const Picture before = draw();
    picture_->view().help_shown = true;
    for (int frame = 0; frame < 3; ++frame) {
        picture_->take_in();
        draw();
    }
    EXPECT_NE(draw(), before) << "help appears";
    EXPECT_FALSE(picture_->has_bone());
    int last = 0;
    for (int call = 0; call < 100'000 && picture_->preparation_percent(); ++call) {
        EXPECT_GE(*picture_->preparation_percent(), last);
        last = *picture_->preparation_percent();
        picture_->take_in();
    }
    EXPECT_GT(last, 50);
    EXPECT_TRUE(picture_->has_bone());
}

TEST_F(SessionPictureTest, ShowsTheBoneOfASessionThatIsLostMeanwhile) {
    picture_->take_in();
    session_.status = LinkStatus::lost;
    prepare();
    EXPECT_TRUE(picture_->has_bone());
    EXPECT_EQ(picture_->link().status, LinkStatus::lost);
}

TEST_F(SessionPictureTest, KeepsViewAndPictureWhileABoneComesAgain) {
    picture_->take_in();
    prepare();
    orbit(picture_->camera(), 0.5, 0.2);
    const Camera turned = picture_->camera();
    session_.replaces = true;
    picture_->take_in();
    EXPECT_TRUE(picture_->preparation_percent());
    EXPECT_TRUE(picture_->has_bone()) << "the one before";
    prepare();
    EXPECT_TRUE(picture_->has_bone());
    EXPECT_EQ(picture_->camera(), turned);
}

TEST_F(SessionPictureTest, DrawsNothingOfTheSessionBeforeInTheNext) {
    picture_->take_in();
    prepare();
    ASSERT_TRUE(picture_->has_bone());
    for (int poll = 0; poll < 10; ++poll) picture_->take_in();
    session_.begin_anew();
    picture_->take_in();
    EXPECT_FALSE(picture_->has_bone()) << "the bone that the one before left";
    EXPECT_EQ(picture_->sight(), SessionSight::preparing);
    EXPECT_FALSE(picture_->tool().has_value());
    prepare();
    EXPECT_TRUE(picture_->has_bone());
    EXPECT_EQ(picture_->sight(), SessionSight::now);
}

TEST_F(SessionPictureTest, ShowsNothingOfASessionBesideAnImport) {
    const testing::TemporaryFolder folder;
    StartScreen start({folder.path(), folder / "home", {"127.0.0.1", 7010}});
    picture_->offer_start(start);
    picture_->resize({1000, 700});
    picture_->take_in();
    prepare();
    zoom(picture_->camera(), 0.1);  // bone is all round the page
    session_.status = LinkStatus::finished;
    picture_->take_in();
    // The colours of a row left of the page.
    const auto margin = [&] {
        const Picture drawn = draw();
        std::set<std::array<std::uint8_t, 3>> colours;
        for (int x = 0; x < 10; ++x) {
            const std::uint8_t* rgb = drawn.at(x, 350);
            colours.insert({rgb[0], rgb[1], rgb[2]});
        }
        return colours;
    };
    EXPECT_GT(margin().size(), 1U) << "what the last session left";
    start.page.show(StartPage::View::scan_browser);
    EXPECT_EQ(margin().size(), 1U) << "one grey";
    start.page.show(StartPage::View::cases);
    EXPECT_GT(margin().size(), 1U);
}

TEST_F(SessionPictureTest, ShowsNoToolWhereNobodyKnowsHowItIs) {
    picture_->take_in();
    prepare();
    picture_->take_in();
    ASSERT_TRUE(picture_->tool().has_value());
    draw();
    const Picture before = draw();
    session_.silent_s = 0.3;
    EXPECT_EQ(picture_->take_in(), SessionNews::change);
    EXPECT_EQ(picture_->sight(), SessionSight::silent);
    EXPECT_FALSE(picture_->tool().has_value());
    draw();
    EXPECT_NE(draw(), before) << "grey, with words in the middle";
    session_.silent_s = 0.0;
    EXPECT_EQ(picture_->take_in(), SessionNews::change);
    EXPECT_TRUE(picture_->tool().has_value());
}

TEST_F(SessionPictureTest, ForgetsTheViewOfTheSessionBefore) {
    picture_->take_in();
    prepare();
    const Camera first = picture_->camera();
    picture_->take_in();
    orbit(picture_->camera(), 0.5, 0.2);
    zoom(picture_->camera(), 0.1);
    picture_->view().cuts.set(0, {1.0, 0.0, 0.0}, 0.0);
    session_.begin_anew();
    picture_->take_in();
    prepare();
    EXPECT_EQ(picture_->camera(), first);
    EXPECT_FALSE(picture_->view().cuts.any());
}

TEST_F(SessionPictureTest, GoesBackToTheFirstViewWhereverTheToolIsNow) {
    picture_->take_in();
    prepare();
    const Camera first = picture_->camera();
    for (int poll = 0; poll < 10; ++poll) picture_->take_in();
    orbit(picture_->camera(), 0.5, 0.2);
    picture_->reset_camera();
    EXPECT_EQ(picture_->camera(), first);
}

TEST_F(SessionPictureTest, SaysThatABoneIsTooLargeOnce) {
    picture_->limit_textures({.budget_bytes = 1000});
    picture_->take_in();
    prepare();
    EXPECT_NE(picture_->bone_problem().find("exceed the graphics memory"), std::string::npos);
    picture_->take_in();
    EXPECT_FALSE(picture_->preparation_percent());
    EXPECT_FALSE(picture_->has_bone());
}

}  // namespace
}  // namespace osteomill::session_picture_test
