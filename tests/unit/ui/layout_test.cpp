#include "render_client/ui/panels/layout.h"

#include <gtest/gtest.h>

namespace osteomill::layout_test {
namespace {

constexpr float margin = 10.0f;

/// The client's requests with everything open, at scale 1.
std::vector<PanelRequest> many_panels(float scale) {
    return {{Anchor::top, {scale * glm::vec2(300, 40)}},
            {Anchor::lower_left, {scale * glm::vec2(320, 70)}},
            {Anchor::upper_left, {scale * glm::vec2(300, 220)}},
            {Anchor::lower_right, {scale * glm::vec2(300, 310), scale * glm::vec2(300, 130)}},
            {Anchor::upper_left, {scale * glm::vec2(330, 100)}},
            {Anchor::upper_right, {scale * glm::vec2(180, 90)}},
            {Anchor::upper_right, {scale * glm::vec2(84, 84)}},
            {Anchor::bottom, {scale * glm::vec2(120, 30)}},
            {Anchor::upper_left, {scale * glm::vec2(160, 140)}}};
}

bool overlap(const PanelPlace& a, const PanelPlace& b) {
    return a.first.x < b.first.x + b.size.x && b.first.x < a.first.x + a.size.x &&
           a.first.y < b.first.y + b.size.y && b.first.y < a.first.y + a.size.y;
}

TEST(Layout, NeverLetsPanelsOverlapOrLeaveThePicture) {
    for (const float scale : {1.0f, 2.0f})
        for (const glm::vec2 picture : {glm::vec2(1, 1), glm::vec2(320, 240), glm::vec2(640, 480),
                                        glm::vec2(800, 600), glm::vec2(1600, 1000), glm::vec2(300, 2000)}) {
            const auto places = lay_out(many_panels(scale), picture, margin);
            for (std::size_t i = 0; i < places.size(); ++i) {
                if (!places[i]) continue;
                EXPECT_GE(places[i]->first.x, margin);
                EXPECT_GE(places[i]->first.y, margin);
                EXPECT_LE(places[i]->first.x + places[i]->size.x, picture.x - margin);
                EXPECT_LE(places[i]->first.y + places[i]->size.y, picture.y - margin);
                for (std::size_t j = 0; j < i; ++j)
                    if (places[j]) {
                        EXPECT_FALSE(overlap(*places[i], *places[j])) << i << " and " << j;
                    }
            }
        }
}

TEST(Layout, ShowsEveryPanelInALargeWindowAtItsAnchor) {
    const glm::vec2 picture(1600, 1000);
    const auto places = lay_out(many_panels(1.0f), picture, margin);
    for (const auto& place : places) ASSERT_TRUE(place);
    EXPECT_EQ(places[0]->first, glm::vec2(650, 10));
    EXPECT_EQ(places[1]->first, glm::vec2(10, 920));
    EXPECT_EQ(places[2]->first, glm::vec2(10, 10));
    EXPECT_EQ(places[3]->first, glm::vec2(1290, 680));
    EXPECT_EQ(places[4]->first, glm::vec2(10, 240)) << "below the panel that has the corner";
}

TEST(Layout, KeepsTheMiddleFree) {
    const std::vector<PanelRequest> requests{{Anchor::lower_right, {{300, 250}, {300, 100}}},
                                             {Anchor::middle, {{50, 50}}, true}};
    const auto places = lay_out(requests, {400, 300}, margin);
    ASSERT_TRUE(places[0]);
    EXPECT_EQ(places[0]->choice, 1u) << "the first size would hide the burr";
    EXPECT_TRUE(places[1]) << "help may";
}

TEST(Layout, KeepsScaleBarAndForceWhateverIsOpen) {
    const std::vector<std::vector<glm::vec2>> controls{{{294, 230}}, {{320, 240}}, {{378, 190}}};
    for (const float wanted : {1.0f, 2.0f})
        for (const glm::vec2 picture : {glm::vec2(500, 400), glm::vec2(640, 400), glm::vec2(500, 900),
                                        glm::vec2(800, 600), glm::vec2(1280, 800), glm::vec2(2560, 1440)})
            for (unsigned open = 0; open < 8; ++open) {
                const float scale = scale_that_fits(wanted, picture);
                const float gap = 12.0f * scale;
                std::vector<PanelRequest> requests{{Anchor::top, {scale * glm::vec2(440, 36)}}};
                for (unsigned i = 0; i < 3; ++i)
                    if ((open >> i & 1U) != 0)
                        requests.push_back(
                            {i < 2 ? Anchor::upper_left : Anchor::lower_left,
                             shrinking_sizes(scale * controls[i][0], picture, gap, 36.0f * scale)});
                for (std::size_t i = 1; i < requests.size(); ++i) requests[i].is_requested = true;
                const std::size_t bar = requests.size();
                requests.push_back(
                    {.anchor = Anchor::bottom, .sizes = {scale * glm::vec2(110, 32)}, .is_kept = true});
                requests.push_back({.anchor = Anchor::lower_right,
                                    .sizes = {scale * glm::vec2(296, 310), scale * glm::vec2(296, 60)},
                                    .is_kept = true,
                                    .gives_way = true});
                // A burr off the middle.
                const PanelPlace burr{0.55f * picture, glm::vec2(30.0f), 0};
                const auto places = lay_out(requests, picture, gap, burr);
                ASSERT_TRUE(places[bar]) << picture.x << " x " << picture.y << ", " << scale << ", " << open;
                ASSERT_TRUE(places[bar + 1])
                    << picture.x << " x " << picture.y << ", " << scale << ", " << open;
                EXPECT_FALSE(overlap(*places[bar + 1], burr));
                const PanelPlace middle{0.4f * picture, 0.2f * picture, 0};
                for (std::size_t i = 0; i < places.size(); ++i) {
                    if (!places[i]) continue;
                    EXPECT_FALSE(overlap(*places[i], middle)) << i;
                    for (std::size_t j = 0; j < i; ++j)
                        if (places[j]) {
                            EXPECT_FALSE(overlap(*places[i], *places[j])) << i << " and " << j;
                        }
                }
                for (std::size_t i = 0; i < bar; ++i)
                    EXPECT_TRUE(places[i])
                        << i << " in " << picture.x << " x " << picture.y << ", " << scale << ", " << open;
            }
}

TEST(Layout, FindsAFreePlaceForALabel) {
    const std::vector<std::optional<PanelPlace>> panels{PanelPlace{{0, 0}, {100, 100}, 0}, std::nullopt};
    const std::vector<glm::vec2> places{{90, 50}, {290, 50}, {110, 50}};
    EXPECT_EQ(free_place(places, {20, 10}, panels, {300, 200}), glm::vec2(110, 50));
    EXPECT_EQ(free_place(std::span(places).first(2), {20, 10}, panels, {300, 200}), std::nullopt);
}

TEST(Layout, DrawsLargeOnlyWhereThereIsRoom) {
    EXPECT_EQ(scale_that_fits(2.0f, {1000, 800}), 2.0f);
    EXPECT_EQ(scale_that_fits(2.0f, {500, 400}), 1.0f);
    EXPECT_EQ(scale_that_fits(0.8f, {300, 200}), 0.8f);
}

TEST(Layout, GivesALessImportantPanelItsSmallerSizeAndThenNone) {
    const std::vector<PanelRequest> requests{{Anchor::upper_left, {{90, 50}}},
                                             {Anchor::lower_left, {{90, 80}, {90, 30}}},
                                             {Anchor::upper_left, {{90, 20}}}};
    const auto places = lay_out(requests, {260, 115}, margin);
    ASSERT_TRUE(places[0]);
    ASSERT_TRUE(places[1]);
    EXPECT_EQ(places[1]->choice, 1u);
    EXPECT_EQ(places[1]->size, glm::vec2(90, 30));
    EXPECT_FALSE(places[2]);
}

}  // namespace
}  // namespace osteomill::layout_test
