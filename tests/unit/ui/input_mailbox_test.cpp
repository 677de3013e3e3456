#include "render_client/ui/input/input_mailbox.h"

#include <gmock/gmock.h>

namespace osteomill::input_mailbox_test {
namespace {

using ::testing::ElementsAre;

TEST(InputMailbox, LosesNothingHoweverSeldomItIsEmptied) {
    InputMailbox mailbox;
    WindowInput click{.cursor = {1.0, 2.0}, .presses = {{65}}, .wheel = {0.0, 1.0}, .has_news = true};
    click.went_down[WindowInput::left] = true;
    click.pressed_at[WindowInput::left] = click.cursor;
    mailbox.post(click);
    mailbox.post({.cursor = {3.0, 4.0}, .presses = {{66}}, .wheel = {0.0, 0.5}, .has_news = true});
    mailbox.post({.cursor = {3.0, 4.0}});

    const WindowInput taken = mailbox.take();
    EXPECT_EQ(taken.cursor, glm::dvec2(3.0, 4.0));
    EXPECT_TRUE(taken.went_down[WindowInput::left]) << "though it is up again";
    EXPECT_EQ(taken.pressed_at[WindowInput::left], glm::dvec2(1.0, 2.0)) << "where it was";
    EXPECT_FALSE(taken.is_down[WindowInput::left]);
    EXPECT_THAT(taken.pressed_keys(), ElementsAre(65, 66));
    EXPECT_EQ(taken.wheel.y, 1.5);
    EXPECT_TRUE(taken.has_news);

    const WindowInput again = mailbox.take();
    EXPECT_EQ(again.cursor, glm::dvec2(3.0, 4.0)) << "the state stays";
    EXPECT_FALSE(again.pressed_at[WindowInput::left]);
    EXPECT_FALSE(again.has_news);
    EXPECT_TRUE(again.presses.empty());
}

TEST(InputMailbox, WaitsForNewsAndNoLongerThanItIsTold) {
    InputMailbox mailbox;
    mailbox.post({.has_news = true});
    mailbox.wait_until(InputMailbox::Time::max());  // returns
    mailbox.take();
    mailbox.wait_until(InputMailbox::Time::min());  // returns, too
    EXPECT_FALSE(mailbox.take().has_news);
}

TEST(WindowInput, CountsPixelsOfDenseDisplays) {
    const WindowInput input{.size = {640.0, 480.0}, .framebuffer_size_px = {1280, 960}};
    EXPECT_EQ(input.px_per_unit(), glm::dvec2(2.0));
}

}  // namespace
}  // namespace osteomill::input_mailbox_test
