#include "analysis/report/session_metrics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "analysis/report/session_plots.h"
#include "tests/support/ball_structure.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/written_session.h"

namespace osteomill {
namespace {

constexpr double period_s = 0.05;
constexpr double spacing_mm = 0.2;
constexpr double voxel_mm3 = spacing_mm * spacing_mm * spacing_mm;

/// A cube of 6.4 mm: soft tissue (1) below x = 0, hard (2) from there on, a nerve (3) above z = 2.
class ReportedSession : public ::testing::Test {
  protected:
    ReportedSession()
        : bone_(testing::labelled_cube(
              2, spacing_mm,
              [](const glm::dvec3& place) {
                  return static_cast<std::uint8_t>(place.z > 2.0 ? 3 : place.x < 0.0 ? 1 : 2);
              })),
          session_{.scene_name = "cube",
                   .burrs = {Burr{.name = "small", .diameter_mm = 1.0}, Burr{.name = "large"}},
                   .tissues = {{.label = 1, .name = "soft"},
                               {.label = 2, .name = "hard"},
                               {.label = 3, .name = "nerve", .is_protected = true}},
                   .force_limit_n = 3.3},
          written_(std::in_place, file(), session_, bone_) {}

    std::filesystem::path file() const { return folder_ / "session.pcap"; }
    void frame(const SessionStatus& status = {}) {
        written_->frame(tool_, status);
        tool_.time_s += period_s;
    }
    SessionTrace trace() {
        written_->finish();
        SessionTrace read = read_trace(file(), [](double) {});
        EXPECT_EQ(read.error, "");
        return read;
    }
    /// A layer of voxels at this height, on one side; 16 x 32 voxels.
    static auto layer(double z_mm, bool is_hard) {
        return [=](const glm::dvec3& place) {
            return std::abs(place.z - z_mm) < 0.5 * spacing_mm && (place.x > 0.0) == is_hard;
        };
    }
    static constexpr double layer_mm3 = 16 * 32 * voxel_mm3;

    testing::TemporaryFolder folder_;
    Bone bone_;
    SessionInfo session_;
    std::optional<testing::WrittenSession> written_;
    ToolState tool_{.hand_position_mm = {0.0, 0.0, 10.0}};
};

TEST_F(ReportedSession, OfAStraightLineAtConstantSpeed) {
    for (int i = 0; i <= 100; ++i) {
        tool_.hand_position_mm = tool_.burr_position_mm = {0.15 * i, -0.2 * i, 10.0};  // 5 mm/s
        tool_.spindle_on = i > 40 && i <= 80;
        if (i > 60 && i <= 70) written_->cut(layer(-3.1 + 0.2 * (i - 61), false));
        frame();
    }
    const SessionMetrics metrics = session_metrics(trace());
    EXPECT_NEAR(metrics.motion.time_s, 5.0, 1e-9);
    EXPECT_NEAR(metrics.motion.path_mm, 25.0, 1e-9);
    EXPECT_NEAR(metrics.motion.spindle_s, 2.0, 1e-9);
    EXPECT_NEAR(metrics.motion.cutting_s, 0.5, 1e-9);
    EXPECT_NEAR(metrics.motion.cutting_speed_mm_per_s, 5.0, 1e-9);
    EXPECT_NEAR(metrics.motion.cutting_speed_p95_mm_per_s, 5.0, 1e-9);
    EXPECT_NEAR(metrics.motion.idle_s, 0.0, 1e-9);
    EXPECT_FALSE(metrics.motion.smoothness);
    ASSERT_EQ(metrics.strokes.strokes, 1u);
    EXPECT_NEAR(metrics.strokes.mean_duration_s, 0.5, 1e-9) << "the air before and behind it is none of it";
    EXPECT_NEAR(metrics.strokes.mean_length_mm, 2.5, 1e-9);
}

TEST_F(ReportedSession, TellsIdleTimeFromPausesAndFromTheTurningSpindle) {
    for (int i = 0; i <= 20; ++i) frame();  // 1 s at rest
    for (int i = 0; i < 20; ++i) {          // 1 s at 1 mm/s, too slow to count
        tool_.hand_position_mm.x += 1.0 * period_s;
        frame();
    }
    for (int i = 0; i < 20; ++i) {  // 1 s at 3 mm/s
        tool_.hand_position_mm.x += 3.0 * period_s;
        frame();
    }
    tool_.spindle_on = true;
    for (int i = 0; i < 20; ++i) frame();
    tool_.spindle_on = false;
    for (int i = 0; i < 20; ++i) frame({.is_paused = true});
    const MotionMetrics motion = session_metrics(trace()).motion;
    EXPECT_NEAR(motion.time_s, 5.0, 1e-9);
    EXPECT_NEAR(motion.idle_s, 2.0, 1e-9);
    EXPECT_NEAR(motion.paused_s, 1.0, 1e-9);
    EXPECT_NEAR(motion.spindle_s, 1.0, 1e-9);
    EXPECT_NEAR(motion.path_mm, 4.0, 1e-9);
}

TEST_F(ReportedSession, CountsNoPlacementAsAWayOfTheHand) {
    // 5 mm/s along x; the tool is placed 40 mm off twice. The frame that reports it may have the tool of
    // before.
    for (int i = 0; i <= 100; ++i) {
        const double placed_mm = (i >= 30 ? 40.0 : 0.0) + (i >= 61 ? 40.0 : 0.0);
        tool_.hand_position_mm = tool_.burr_position_mm = {0.25 * i, placed_mm, 10.0};
        if (i == 30 || i == 60)
            written_->event({.time_s = tool_.time_s, .action = SessionAction::place, .text = "there"});
        if (i == 80)  // nothing came of it
            written_->event({.time_s = tool_.time_s,
                             .action = SessionAction::place,
                             .text = "too far",
                             .is_refused = true});
        frame();
    }
    const SessionTrace read = trace();
    const MotionMetrics motion = session_metrics(read).motion;
    EXPECT_NEAR(motion.path_mm, 0.25 * 96, 1e-9) << "two frames about each placement are left out";
    EXPECT_NEAR(motion.time_s, 5.0, 1e-9);
    EXPECT_FALSE(motion.smoothness) << "a straight line at constant speed has no jerk";
    for (const SvgPlot& plot : session_plots(read))
        if (plot.title == "Speed of the burr") {
            EXPECT_LT(*std::ranges::max_element(plot.lines.at(0).y), 5.001);
        }
}

TEST_F(ReportedSession, GivesEachTissueItsForceAndVolume) {
    frame();
    tool_.spindle_on = true;
    const auto mill = [&](bool is_hard, double force_n, int frames) {
        tool_.force_n = {0.0, 0.6 * force_n, -0.8 * force_n};
        for (int i = 0; i < frames; ++i) {
            written_->cut(layer(-3.1 + 0.2 * i, is_hard));
            frame();
        }
    };
    mill(false, 0.5, 10);
    tool_.burr = 1;
    mill(true, 2.0, 20);
    tool_.force_n = {3.0, 0.0, 0.0};  // pressed, nothing goes
    tool_.peak_force_n = 3.25;        // between two frames
    frame();
    const SessionMetrics metrics = session_metrics(trace());
    EXPECT_EQ(metrics.force.peak_n, 3.25);
    ASSERT_EQ(metrics.force.by_tissue.size(), 2u);
    const auto expect = [](const ForceOf& force, const char* name, double n, double s) {
        EXPECT_EQ(force.name, name);
        EXPECT_NEAR(force.mean_n, n, 1e-12);
        EXPECT_NEAR(force.p95_n, n, 1e-12);
        EXPECT_NEAR(force.time_s, s, 1e-9);
        EXPECT_NEAR(force.impulse_n_s, n * s, 1e-9);
    };
    expect(metrics.force.by_tissue[0], "soft", 0.5, 0.5);
    expect(metrics.force.by_tissue[1], "hard", 2.0, 1.0);
    ASSERT_EQ(metrics.force.by_burr.size(), 2u);
    expect(metrics.force.by_burr[0], "small", 0.5, 0.5);
    expect(metrics.force.by_burr[1], "large", 2.0, 1.0);
    EXPECT_NEAR(metrics.force.cutting.mean_n, 1.5, 1e-9);

    EXPECT_NEAR(metrics.removal.removed_mm3, 30 * layer_mm3, 1e-9);
    ASSERT_EQ(metrics.removal.by_tissue.size(), 3u);
    EXPECT_NEAR(metrics.removal.by_tissue[0].mm3, 10 * layer_mm3, 1e-9);
    EXPECT_NEAR(metrics.removal.by_tissue[1].mm3, 20 * layer_mm3, 1e-9);
    EXPECT_EQ(metrics.removal.by_tissue[2].mm3, 0.0);
    ASSERT_EQ(metrics.removal.by_burr.size(), 2u);
    EXPECT_EQ(metrics.removal.by_burr[0].name, "small");
    EXPECT_NEAR(metrics.removal.by_burr[0].mm3, 10 * layer_mm3, 1e-9);
    EXPECT_NEAR(metrics.removal.by_burr[1].mm3, 20 * layer_mm3, 1e-9);
}

TEST_F(ReportedSession, MeasuresTheAngleOfTheSpindleToTheSurface) {
    // The cube's top, at z = 3.2, under a spindle that leans by 30 degrees: 60 to the surface.
    tool_.burr_position_mm = {0.0, 0.0, 3.0};
    tool_.spindle_axis = {0.5, 0.0, std::sqrt(0.75)};
    frame();
    EXPECT_GT(
        written_->cut([](const glm::dvec3& at) { return glm::length(at - glm::dvec3(0, 0, 3.0)) < 0.5; }),
        0u);
    tool_.spindle_on = true;
    frame();
    const SessionMetrics metrics = session_metrics(trace());
    ASSERT_TRUE(metrics.motion.cutting_angle_deg);
    EXPECT_NEAR(*metrics.motion.cutting_angle_deg, 60.0, 2.0);
}

TEST(StrokeMetricsTest, TellsHowMuchStrokesVary) {
    const auto stroke = [](double length_mm, double force_n_s) {
        return Stroke{.duration_s = 2.0,
                      .length_mm = length_mm,
                      .force_n_s = force_n_s,
                      .smoothness = -std::log(204.8 * 16.0)};
    };
    const StrokeMetrics metrics = stroke_metrics({stroke(1.0, 4.0), stroke(2.0, 4.0), stroke(3.0, 4.0)});
    EXPECT_NEAR(*metrics.length_variation, 0.5, 1e-12) << "standard deviation 1, mean 2";
    EXPECT_NEAR(*metrics.force_variation, 0.0, 1e-12);
    EXPECT_NEAR(*metrics.median_reaches_per_s, 1.0, 1e-12) << "as two reaches in 2 s";
    EXPECT_FALSE(stroke_metrics({stroke(1.0, 4.0), stroke(2.0, 4.0)}).length_variation);
}

TEST_F(ReportedSession, CallsWhatHasNoLabelBone) {
    EXPECT_EQ(tissue_name(session_, 0), "bone");
    session_.tissues.push_back({.label = 4, .name = "bone"});
    EXPECT_EQ(tissue_name(session_, 0), "other bone");
    EXPECT_EQ(tissue_name(session_, 9), "tissue 9");
}

TEST_F(ReportedSession, WithTicksKnowsWhatWasBetweenItsFrames) {
    written_.emplace(file(), session_, bone_, std::vector<Structure>{}, true);
    frame();
    tool_.force_n = {1.0, 0.0, 0.0};  // that of the frames, which say less
    for (int i = 0; i < 20; ++i) {
        // 50 ticks a frame, of 0, 1, ... 49 N; the spindle turns and the burr is deep in the last 10.
        for (int k = 0; k < 50; ++k)
            written_->tick({.time_s = tool_.time_s - 0.001 * (49 - k),
                            .force_n = {0.0, 0.0, static_cast<double>(k)},
                            .depth_mm = k < 40    ? 9.0
                                        : k == 45 ? 0.5
                                                  : 0.25,
                            .spindle_on = k >= 40});
        tool_.spindle_on = true;
        tool_.depth_mm = 0.25;
        if (i % 2 == 0) written_->cut(layer(-3.1 + 0.2 * i, true));
        frame();
    }
    const SessionMetrics metrics = session_metrics(trace());
    EXPECT_NEAR(metrics.force.cutting.mean_n, 24.5, 1e-6);
    EXPECT_NEAR(metrics.force.cutting.time_s, 0.5, 1e-6);
    EXPECT_NEAR(metrics.force.cutting.impulse_n_s, 0.5 * 24.5, 1e-6);
    EXPECT_NEAR(metrics.force.cutting.p95_n, 47.0, 0.5);
    EXPECT_NEAR(metrics.motion.spindle_s, 20 * 0.010, 1e-6);
    EXPECT_EQ(metrics.motion.depth_mm, 0.5);
    EXPECT_NEAR(metrics.motion.time_s, 1.0, 1e-9);
}

TEST_F(ReportedSession, DoesNotCountWhatWasUndone) {
    const auto stroke = [&](double z_mm) {
        tool_.spindle_on = true;
        frame();
        written_->cut(layer(z_mm, true));
        frame();
        tool_.spindle_on = false;
        frame();
    };
    const auto act = [&](SessionAction action) {
        written_->event({.time_s = tool_.time_s, .action = action});
        frame();
    };
    frame();
    stroke(-3.1);
    tool_.burr = 1;
    stroke(-2.9);
    stroke(-2.7);
    act(SessionAction::undo);
    written_->restore(layer(-2.7, true));
    frame();
    act(SessionAction::undo);
    written_->restore(layer(-2.9, true));
    frame();
    act(SessionAction::redo);
    written_->redo(layer(-2.9, true));
    frame();
    written_->event({.time_s = tool_.time_s, .action = SessionAction::undo, .is_refused = true});
    frame();
    const SessionMetrics metrics = session_metrics(trace());
    EXPECT_EQ(metrics.strokes.strokes, 3u);
    EXPECT_EQ(metrics.strokes.undone, 1u);
    EXPECT_NEAR(metrics.removal.removed_mm3, 2 * layer_mm3, 1e-9);
    EXPECT_NEAR(metrics.removal.undone_mm3, layer_mm3, 1e-9);
    ASSERT_EQ(metrics.removal.by_burr.size(), 2u);
    EXPECT_NEAR(metrics.removal.by_burr[0].mm3, layer_mm3, 1e-9);
    EXPECT_NEAR(metrics.removal.by_burr[1].mm3, layer_mm3, 1e-9);
    EXPECT_EQ(metrics.removal.undos, 1u) << "the other one was redone";
}

TEST_F(ReportedSession, CountsAResetUntilAllOfItIsRedone) {
    const auto act = [&](SessionAction action) {
        written_->event({.time_s = tool_.time_s, .action = action});
        frame();
    };
    frame();
    for (const double z_mm : {-3.1, -2.9}) {
        tool_.spindle_on = true;
        written_->cut(layer(z_mm, true));
        frame();
        tool_.spindle_on = false;
        frame();
    }
    act(SessionAction::reset);
    act(SessionAction::redo);
    act(SessionAction::reset);
    act(SessionAction::redo);
    act(SessionAction::redo);
    act(SessionAction::undo);
    const SessionMetrics metrics = session_metrics(trace());
    EXPECT_EQ(metrics.removal.undos, 1u) << "of both resets nothing is left; the last undo stands";
}

TEST_F(ReportedSession, EndsAStrokeInAirAsTheServerDoes) {
    tool_.spindle_on = true;
    const auto touch = [&](double z_mm) {
        written_->cut(layer(z_mm, true));
        frame();
    };
    frame();
    touch(-3.1);
    for (int i = 0; i < 5; ++i) frame();  // 0.25 s
    touch(-2.9);
    for (int i = 0; i < 15; ++i) frame();
    touch(-2.7);
    tool_.spindle_on = false;
    frame();
    written_->event({.time_s = tool_.time_s, .action = SessionAction::undo});
    frame();
    const SessionMetrics metrics = session_metrics(trace());
    EXPECT_EQ(metrics.strokes.strokes, 2u);
    EXPECT_EQ(metrics.strokes.undone, 1u);
    EXPECT_NEAR(metrics.strokes.longest_s, 7 * period_s, 1e-9);
}

TEST_F(ReportedSession, TellsHowNearAProtectedStructureWasAndWhatItLost) {
    // The nerve begins at z = 2; the small burr has a radius of 0.5.
    tool_.burr_position_mm = {0.1, 0.1, 0.1};
    frame();
    tool_.burr_position_mm = {0.1, 0.1, 1.1};
    frame();
    std::filesystem::copy_file(folder_ / "session.part.pcap", folder_ / "so_far.pcap");
    const auto far = session_metrics(read_trace(folder_ / "so_far.pcap", [](double) {})).structures;
    ASSERT_EQ(far.size(), 1u);
    if (far[0].nearest_mm) {
        EXPECT_GE(*far[0].nearest_mm, 0.4 - 1e-5);
    }

    tool_.spindle_on = true;
    const auto touch = [&](double z_mm) {
        written_->cut(layer(z_mm, true));
        frame();
    };
    const double first_s = tool_.time_s;
    touch(2.1);
    touch(2.3);                            // the same
    for (int i = 0; i < 20; ++i) frame();  // 1 s
    touch(2.5);                            // another
    written_->restore(layer(2.5, true));   // which is undone, though not the touch
    frame();
    const auto near = session_metrics(trace()).structures;
    ASSERT_EQ(near.size(), 1u);
    EXPECT_EQ(near[0].name, "nerve");
    EXPECT_EQ(near[0].nearest_mm, 0.0);
    EXPECT_EQ(near[0].touches, 2u);
    EXPECT_NEAR(*near[0].first_touch_s, first_s, 1e-9);
    EXPECT_NEAR(near[0].dose_mm3, 2 * layer_mm3, 1e-9);
    EXPECT_NEAR(near[0].undone_dose_mm3, layer_mm3, 1e-9);
    EXPECT_EQ(near[0].entered_mm3, 0.0) << "the head was not in it";
}

TEST_F(ReportedSession, MeasuresTheNearestApproachFromTheBallToTheStructure) {
    tool_.burr_position_mm = {0.1, 0.1, 0.1};
    frame();
    tool_.burr_position_mm = {0.1, 0.1, 1.1};
    frame();
    tool_.burr_position_mm = {0.1, 0.1, -2.0};
    frame();
    const auto structures = session_metrics(trace()).structures;
    ASSERT_EQ(structures.size(), 1u);
    EXPECT_NEAR(*structures[0].nearest_mm, 2.0 - 1.1 - 0.5, 1e-5);
    EXPECT_EQ(structures[0].touches, 0u);
    EXPECT_FALSE(structures[0].first_touch_s);
}

// A nerve beside the cube, outside bone: a ball of 1.5 mm about x = 6, of which only the recording knows.
TEST_F(ReportedSession, MeasuresASoftStructureThatOnlyTheRecordingTells) {
    const Grid grid{.size_voxels = {96, 32, 32}, .spacing_mm = spacing_mm, .origin_mm = glm::dvec3(-3.1)};
    auto builder = BoneBuilder::homogeneous(grid, 1.0, false);
    ByteBrick full;
    full.fill(255);
    builder.add_brick({0, 0, 0}, full, nullptr, nullptr);
    const std::vector<Structure> nerve{{2, testing::ball_mask(grid, {6.0, 0.0, 0.0}, 1.5)}};
    written_.emplace(file(), session_, std::move(builder).build(), nerve);
    for (const double distance_mm : {9.0, 2.0, 0.8, 1.5}) {
        tool_.burr_position_mm = {6.0, 0.0, 1.5 + 0.5 + distance_mm};
        frame();
    }
    std::filesystem::copy_file(folder_ / "session.part.pcap", folder_ / "so_far.pcap");
    const auto so_far = session_metrics(read_trace(folder_ / "so_far.pcap", [](double) {})).structures;
    ASSERT_EQ(so_far.size(), 1u);
    EXPECT_EQ(so_far[0].name, "nerve");
    if (so_far[0].nearest_mm) {
        EXPECT_GT(*so_far[0].nearest_mm, 0.8 - 0.5 * spacing_mm);
    }

    const double first_s = tool_.time_s;
    for (int i = 0; i < 4; ++i) {
        tool_.burr_position_mm = {6.0, 0.0, 0.0};
        frame();
    }
    tool_.burr_position_mm = {0.0, 0.0, 30.0};
    frame();
    const SessionTrace all = trace();
    const auto touched = session_metrics(all).structures;
    ASSERT_EQ(touched.size(), 1u);
    EXPECT_EQ(touched[0].nearest_mm, 0.0);
    EXPECT_EQ(touched[0].touches, 1u);
    EXPECT_NEAR(*touched[0].first_touch_s, first_s, 1e-9);
    EXPECT_NEAR(touched[0].touched_s, 4 * period_s, 1e-9);
    EXPECT_EQ(touched[0].dose_mm3, 0.0) << "there was no bone";
    EXPECT_NEAR(touched[0].entered_mm3, 4.0 / 3.0 * 3.14159 * 0.125, 0.1) << "all of the burr's ball";
}

TEST_F(ReportedSession, MeasuresTheNearestApproachToASoftStructure) {
    const std::vector<Structure> nerve{{2, testing::ball_mask(bone_.grid(), {0.0, 0.0, 0.0}, 1.5)}};
    written_.emplace(file(), session_, bone_, nerve);
    for (const double distance_mm : {9.0, 2.0, 0.8, 1.5}) {
        tool_.burr_position_mm = {0.0, -(1.5 + 0.5 + distance_mm), 0.0};
        frame();
    }
    const auto structures = session_metrics(trace()).structures;
    ASSERT_EQ(structures.size(), 1u);
    EXPECT_NEAR(*structures[0].nearest_mm, 0.8, 0.5 * spacing_mm);
    EXPECT_EQ(structures[0].touches, 0u);
}

TEST_F(ReportedSession, IsOfNothingWhereNothingWasDone) {
    frame();
    const SessionTrace nothing = trace();
    const SessionMetrics metrics = session_metrics(nothing);
    EXPECT_EQ(metrics.motion.time_s, 0.0);
    EXPECT_EQ(metrics.strokes.strokes, 0u);
    EXPECT_EQ(metrics.removal.removed_mm3, 0.0);
    EXPECT_EQ(metrics.force.cutting.mean_n, 0.0);
    EXPECT_FALSE(metrics.plan);
    for (const MetricRow& row : metric_rows(metrics))
        if (row.value) {
            EXPECT_TRUE(std::isfinite(*row.value)) << row.key;
        }
}

}  // namespace
}  // namespace osteomill
