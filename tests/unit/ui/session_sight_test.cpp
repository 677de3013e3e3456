#include "render_client/ui/view/session_sight.h"

#include <gmock/gmock.h>

#include "render_client/ui/panels/panel_text.h"
#include "render_client/ui/panels/sight_panel.h"

namespace osteomill::session_sight_test {
namespace {

using ::testing::IsEmpty;
using ::testing::Not;

struct State {
    const char* name;
    LinkStatus status;
    double silent_s;
    bool has_bone;
    bool is_recording;
    SessionSight sight;
};

constexpr State states[]{
    {"no server yet", LinkStatus::connecting, 0.0, false, false, SessionSight::none},
    {"a server's bone comes", LinkStatus::receiving_snapshot, 0.0, false, false, SessionSight::coming},
    {"a bone comes after another", LinkStatus::receiving_snapshot, 0.0, true, false, SessionSight::coming},
    {"the bone is prepared", LinkStatus::live, 0.0, false, false, SessionSight::preparing},
    {"a session", LinkStatus::live, 0.03, true, false, SessionSight::now},
    {"a session whose frames are late", LinkStatus::live, 0.2, true, false, SessionSight::now},
    {"a server that is killed without a word", LinkStatus::live, 0.26, true, false, SessionSight::silent},
    {"silence before the bone is there", LinkStatus::live, 0.26, false, false, SessionSight::silent},
    {"a cut cable", LinkStatus::lost, 0.0, true, false, SessionSight::lost},
    {"another protocol", LinkStatus::refused, 0.0, true, false, SessionSight::lost},
    {"the end", LinkStatus::finished, 9.0, true, false, SessionSight::over},
    {"a recording that is paused", LinkStatus::live, 9.0, true, true, SessionSight::now},
};

/// Each element of the window that shows the session, in each state.
TEST(SessionSight, ShowsInEachStateOnlyWhatIsSo) {
    SessionInfo session;
    session.scene_name = "jaw";
    session.tissues = {{.label = 1, .name = "nerve", .is_protected = true}};
    session.accepts_controls = true;
    for (const State& state : states) {
        SCOPED_TRACE(state.name);
        LinkUpdate link;
        link.status = state.status;
        link.silent_s = state.silent_s;
        link.status_line = "cannot reach 127.0.0.1:9999";
        link.distances = {{.tissue = 0, .distance_mm = -0.1, .touches = true}};
        link.controls.is_paused = true;
        const SessionSight sight = sight_of(link, state.has_bone, state.is_recording);
        EXPECT_EQ(sight, state.sight);
        const SightElements elements = elements_of(sight);
        const SeenSession seen{
            .link = link, .info = &session, .sight = sight, .is_recording = state.is_recording};
        const bool is_now = sight == SessionSight::now;
        const bool is_over = sight == SessionSight::over;
        EXPECT_EQ(elements.tool, is_now || is_over) << "burr, spindle, force";
        EXPECT_EQ(elements.controls, is_now);
        EXPECT_EQ(elements.is_grey, !is_now && !is_over && sight != SessionSight::none);
        EXPECT_EQ(seen.takes_controls(), is_now && !state.is_recording) << "buttons";
        EXPECT_EQ(is_alarm(seen), is_now || is_over) << "the alarm";
        EXPECT_EQ(structure_warnings(seen).empty(), !is_now && !is_over) << "warnings";
        EXPECT_EQ(warning_text(seen, "", "").empty(), !is_now && !is_over) << "banners";
        EXPECT_EQ(elements.has_words, !is_now && !is_over);
        EXPECT_EQ(words_of_sight(seen, std::nullopt).title.empty(), !elements.has_words);
        if (sight == SessionSight::silent || sight == SessionSight::lost || sight == SessionSight::none) {
            EXPECT_THAT(words_of_sight(seen, std::nullopt).cause, Not(IsEmpty()));
            EXPECT_THAT(words_of_sight(seen, std::nullopt).advice, Not(IsEmpty()));
        }
    }
}

}  // namespace
}  // namespace osteomill::session_sight_test
