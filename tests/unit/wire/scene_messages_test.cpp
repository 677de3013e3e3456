#include "common/wire/scene_messages.h"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <limits>

namespace osteomill {
namespace {

using ::testing::HasSubstr;
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

template <typename T>
std::string error_of(const std::variant<T, WireError>& result) {
    const auto* error = std::get_if<WireError>(&result);
    return error == nullptr ? "" : error->line;
}

TEST(SceneMessages, BringBackBurrsWithoutTheirCoefficients) {
    const Burr burr{.name = "round 1.5",
                    .diameter_mm = 1.5,
                    .edges = 8,
                    .spindle_rev_per_s = 500.0,
                    .sense = SpindleSense::counter_clockwise};
    v2::Hello hello;
    *hello.add_burrs() = to_message(burr);
    const auto burrs = burrs_from(hello.burrs());
    ASSERT_EQ(error_of(burrs), "");
    const Burr& back = std::get<0>(burrs).at(0);
    EXPECT_EQ(back.name, burr.name);
    EXPECT_DOUBLE_EQ(back.diameter_mm, 1.5);
    EXPECT_EQ(back.edges, 8);
    EXPECT_DOUBLE_EQ(back.spindle_rev_per_s, 500.0);
    EXPECT_EQ(back.sense, burr.sense);
    EXPECT_EQ(back.cutting_coefficients_n_per_mm2, glm::dvec3(0.0));
}

TEST(SceneMessages, RefuseImpossibleBurrsAndTissues) {
    v2::Hello hello;
    EXPECT_THAT(error_of(burrs_from(hello.burrs())), HasSubstr("no burr"));
    *hello.add_burrs() = to_message(Burr{.name = "b"});
    hello.mutable_burrs(0)->set_diameter_mm(not_a_number);
    EXPECT_THAT(error_of(burrs_from(hello.burrs())), HasSubstr("\"b\""));
    hello.mutable_burrs(0)->set_name("two\nlines");
    EXPECT_THAT(error_of(burrs_from(hello.burrs())), HasSubstr("\"two\\x0alines\""));
    *hello.add_tissues() = to_message(Tissue{.label = 3, .name = "pulp"});
    EXPECT_EQ(error_of(tissues_from(hello.tissues())), "");
    hello.mutable_tissues(0)->set_label(256);
    EXPECT_THAT(error_of(tissues_from(hello.tissues())), HasSubstr("\"pulp\""));
}

TEST(SceneMessages, BringBackTissues) {
    v2::Hello hello;
    *hello.add_tissues() = to_message(
        Tissue{.label = 255, .name = "nerve canal", .colour_rgb = {250, 200, 7}, .is_protected = true});
    const auto tissues = std::get<0>(tissues_from(hello.tissues()));
    ASSERT_EQ(tissues.size(), 1U);
    EXPECT_EQ(tissues[0].label, 255);
    EXPECT_EQ(tissues[0].name, "nerve canal");
    EXPECT_THAT(tissues[0].colour_rgb, ::testing::ElementsAre(250, 200, 7));
    EXPECT_TRUE(tissues[0].is_protected);
}

TEST(SceneMessages, BringBackTheTool) {
    const ToolState tool{.time_s = 12.5,
                         .burr_position_mm = {1, 2, 3},
                         .spindle_axis = {0, 1, 0},
                         .hand_position_mm = {4, 5, 6},
                         .force_n = {0.1, -0.2, 0.3},
                         .burr = 1,
                         .spindle_on = true,
                         .removed_mm3 = 7.25,
                         .touches_protected = true,
                         .fault = "the device is lost",
                         .notice = "the burr waits",
                         .driver = ToolDriver::another,
                         .depth_mm = -0.5,
                         .solve = SolveCounts{2e-4, 3, 1, 5},
                         .shank_torque_n_mm = glm::dvec3(1.5, -2.0, 0.25)};
    const auto result = tool_from(to_message(tool), 2);
    ASSERT_EQ(error_of(result), "");
    const ToolState& back = std::get<0>(result);
    EXPECT_EQ(back.time_s, tool.time_s);
    EXPECT_EQ(back.burr_position_mm, tool.burr_position_mm);
    EXPECT_EQ(back.spindle_axis, tool.spindle_axis);
    EXPECT_EQ(back.hand_position_mm, tool.hand_position_mm);
    EXPECT_EQ(back.force_n, tool.force_n);
    EXPECT_EQ(back.burr, 1U);
    EXPECT_TRUE(back.spindle_on);
    EXPECT_EQ(back.removed_mm3, 7.25);
    EXPECT_TRUE(back.touches_protected);
    EXPECT_EQ(back.fault, tool.fault);
    EXPECT_EQ(back.notice, tool.notice);
    EXPECT_EQ(back.driver, ToolDriver::another);
    for (const ToolDriver driver :
         {ToolDriver::unknown, ToolDriver::nobody, ToolDriver::you, ToolDriver::others_only})
        EXPECT_EQ(std::get<0>(tool_from(to_message(ToolState{.driver = driver}), 1)).driver, driver);
    EXPECT_EQ(back.depth_mm, -0.5);
    EXPECT_EQ(back.solve, tool.solve);
    EXPECT_EQ(back.shank_torque_n_mm, tool.shank_torque_n_mm);
    EXPECT_EQ(std::get<0>(tool_from(to_message(ToolState{}), 1)).shank_torque_n_mm, std::nullopt);
    EXPECT_THAT(
        error_of(tool_from(to_message(ToolState{.shank_torque_n_mm = glm::dvec3(not_a_number, 0, 0)}), 1)),
        HasSubstr("not finite"));
    EXPECT_EQ(std::get<0>(tool_from(to_message(ToolState{}), 1)).solve, std::nullopt);
    EXPECT_THAT(error_of(tool_from(to_message(ToolState{.solve = SolveCounts{not_a_number}}), 1)),
                HasSubstr("not finite"));
    EXPECT_EQ(std::get<0>(tool_from(to_message(ToolState{}), 1)).depth_mm, std::nullopt);
    EXPECT_THAT(error_of(tool_from(to_message(tool), 1)), HasSubstr("burr 1 is not one of the scene's 1"));
    EXPECT_THAT(error_of(tool_from(to_message(ToolState{.force_n = {0, not_a_number, 0}}), 1)),
                HasSubstr("not finite"));
    EXPECT_THAT(error_of(tool_from(to_message(ToolState{.depth_mm = not_a_number}), 1)),
                HasSubstr("not finite"));
}

TEST(SceneMessages, MakeTheOperatorsAxisAUnitVector) {
    const auto command = std::get<0>(operator_command_from(
        to_message(OperatorCommand{.hand_target_mm = {1, 2, 3}, .spindle_axis = {0, 0, 5}, .pedal = true}),
        1));
    EXPECT_EQ(command.spindle_axis, glm::dvec3(0, 0, 1));
    EXPECT_EQ(command.hand_target_mm, glm::dvec3(1, 2, 3));
    EXPECT_TRUE(command.pedal);
}

TEST(SceneMessages, CarryHeadsThatAreNoBall) {
    const Burr pear{.name = "pear", .diameter_mm = 2.0, .head = usual_head(HeadShape::pear, 2.0, 4.0)};
    google::protobuf::RepeatedPtrField<v2::BurrDescription> messages;
    *messages.Add() = to_message(Burr{.name = "ball"});
    *messages.Add() = to_message(pear);
    EXPECT_FALSE(messages[0].has_head()) << "a ball costs nothing";
    const auto back = std::get<0>(burrs_from(messages));
    EXPECT_TRUE(back[0].is_ball());
    EXPECT_EQ(back[1].head, pear.head);
    messages[1].mutable_head()->set_shape("of a newer server");
    EXPECT_TRUE(std::get<0>(burrs_from(messages))[1].is_ball());
    messages[1].mutable_head()->set_shape("cone");
    EXPECT_THAT(error_of(burrs_from(messages)), HasSubstr("impossible shape"));
    messages[1].mutable_head()->set_length_mm(std::numeric_limits<double>::quiet_NaN());
    EXPECT_THAT(error_of(burrs_from(messages)), HasSubstr("impossible shape"));
}

TEST(SceneMessages, RefuseAnOperatorWhoAsksTheImpossible) {
    EXPECT_THAT(error_of(operator_command_from(
                    to_message(OperatorCommand{.hand_target_mm = {not_a_number, 0, 0}}), 1)),
                HasSubstr("not finite"));
    EXPECT_THAT(error_of(operator_command_from(to_message(OperatorCommand{.spindle_axis = {0, 0, 0}}), 1)),
                HasSubstr("no length"));
    EXPECT_THAT(error_of(operator_command_from(v2::OperatorInput(), 1)), HasSubstr("no length"));
    EXPECT_THAT(error_of(operator_command_from(to_message(OperatorCommand{.burr = 4}), 4)),
                HasSubstr("burr 4"));
}

TEST(SceneMessages, BringBackARating) {
    const SessionInfo session{
        .burrs = {Burr{.name = "round"}},
        .rating = {{.name = "Nerve kept", .points = 2.0, .when = "structure_touches == 0", .source = "ours"},
                   {.name = "Later", .when = "what_a_later_version_knows > 1"},
                   {.name = "Opened",
                    .when = "region_removed_share > 0.5",
                    .region = SphereRegion{{1, 2, 3}, 4.0}}}};
    const v2::Hello good = to_message(session);
    EXPECT_EQ(std::get<SessionInfo>(session_info_from(good)).rating, session.rating);
    const auto wrong = [&](const auto& change) {
        v2::Hello hello = good;
        change(*hello.mutable_rating(0));
        return error_of(session_info_from(hello));
    };
    for (const double points : {std::nan(""), -1.0, 0.0, 1e9})
        EXPECT_THAT(wrong([&](v2::RatingItem& item) { item.set_points(points); }),
                    HasSubstr("impossible points"));
    EXPECT_THAT(wrong([](v2::RatingItem& item) { item.set_when(std::string(501, '(')); }),
                HasSubstr("too long a text"));
    EXPECT_THAT(wrong([](v2::RatingItem& item) { item.mutable_region()->set_margin_mm(1.0); }),
                HasSubstr("no region"));
    v2::Hello many = good;
    for (int i = 0; i < 100; ++i) *many.add_rating() = many.rating(0);
    EXPECT_THAT(error_of(session_info_from(many)), HasSubstr("103 items"));
    v2::Hello steered = good;
    steered.mutable_rating(0)->set_name("a\x1b[2J");
    EXPECT_EQ(std::get<SessionInfo>(session_info_from(steered)).rating[0].name, "a\\x1b[2J");
}

TEST(SceneMessages, BringBackFixturesAndSpendNoByteWhereThereAreNone) {
    const auto usual = [](const char* name, FixtureKind kind) {
        Fixture fixture = usual_fixture(kind);
        fixture.name = name;
        // These are of guides, and not said of others.
        if (kind != FixtureKind::guide) fixture.reach_mm = 0.0;
        return fixture;
    };
    Fixture tube = usual("Shaft", FixtureKind::guide);
    tube.path = LineGuide{{0.0, 0.0, 11.0}, {0.0, 1.0, 5.0}};
    tube.radius_mm = 1.5;
    Fixture plane = usual("Floor", FixtureKind::guide);
    plane.path = PlaneGuide{{1.0, 2.0, 3.0}, {0.0, 0.6, 0.8}};
    Fixture off = usual("Off the pulp", FixtureKind::forbidden);
    off.tissue = "pulp";
    off.distance_mm = 0.5;
    Fixture slow = usual("Slowly", FixtureKind::slow);
    slow.tissue = "pulp";
    const SessionInfo plain{.burrs = {{.name = "b"}}};
    SessionInfo session = plain;
    session.fixtures = {tube, plane, off, slow};
    const v2::Hello good = to_message(session);
    const auto back = session_info_from(good);
    ASSERT_EQ(error_of(back), "");
    EXPECT_EQ(std::get<SessionInfo>(back).fixtures, session.fixtures);
    v2::Hello without = good;
    without.clear_fixtures();
    EXPECT_EQ(without.ByteSizeLong(), to_message(plain).ByteSizeLong());

    const auto error_after = [&](const std::function<void(v2::FixtureDescription&)>& change, int number) {
        v2::Hello hello = good;
        change(*hello.mutable_fixtures(number));
        return error_of(session_info_from(hello));
    };
    using Message = v2::FixtureDescription;
    EXPECT_EQ(error_after([](Message& m) { *m.mutable_line()->mutable_to_mm() = m.line().from_mm(); }, 0),
              "the fixture \"Shaft\" has an impossible place or length");
    EXPECT_NE(error_after([](Message& m) { m.mutable_line()->mutable_to_mm()->set_x(not_a_number); }, 0), "");
    EXPECT_NE(error_after([](Message& m) { m.set_radius_mm(-1.0); }, 0), "");
    EXPECT_NE(error_after([](Message& m) { m.mutable_plane()->clear_normal(); }, 1), "");
    EXPECT_NE(error_after([](Message& m) { m.mutable_region()->set_distance_mm(not_a_number); }, 2), "");
    EXPECT_EQ(error_after([](Message& m) { m.clear_name(); }, 3),
              "a fixture has a name of 0 bytes; it must have 1 to 100");
    v2::Hello newer = good;
    newer.mutable_fixtures(2)->clear_shape();
    EXPECT_EQ(std::get<SessionInfo>(session_info_from(newer)).fixtures.at(2).tissue, "")
        << "of a later version: known by name alone";
    v2::Hello many = good;
    for (int i = 0; i < 13; ++i) *many.add_fixtures() = good.fixtures(0);
    EXPECT_EQ(error_of(session_info_from(many)), "the scene has 17 fixtures; at most 16 are taken");
}

TEST(SceneMessages, BringBackWhichFixturesAreOnAndAct) {
    const ToolState tool{.fixtures_on = 0b101, .fixtures_acting = 0b100};
    const auto back = std::get<ToolState>(tool_from(to_message(tool), 1));
    EXPECT_EQ(back.fixtures_on, tool.fixtures_on);
    EXPECT_EQ(back.fixtures_acting, tool.fixtures_acting);
    v2::ToolState without = to_message(tool);
    without.clear_fixtures_on();
    without.clear_fixtures_acting();
    EXPECT_EQ(without.ByteSizeLong(), to_message(ToolState{}).ByteSizeLong());
}

TEST(SceneMessages, BringBackPlanTraineeAndSettings) {
    SessionInfo session{.burrs = {Burr{.name = "round"}},
                        .plan = Plan{.region = CylinderRegion{{1, 2, 3}, {4, 5, 6}, 2.0}, .margin_mm = 0.25},
                        .pass = {{"time_s", 300.0}, {"structure_touches", 0.0}},
                        .trainee = "Anna",
                        .case_name = "molar",
                        .settings = {{"grip", "firm"}, {"rpm", "40000"}}};
    for (const Plan& plan : {*session.plan, Plan{.region = SphereRegion{{1, 2, 3}, 4.0}},
                             Plan{.region = TissueRegion{"lesion"}}}) {
        session.plan = plan;
        const auto read = std::get<SessionInfo>(session_info_from(to_message(session)));
        EXPECT_EQ(read.plan, plan);
        EXPECT_EQ(read.trainee, "Anna");
        EXPECT_EQ(read.case_name, "molar");
        EXPECT_EQ(read.settings, session.settings);
        EXPECT_EQ(read.pass, session.pass);
    }
    v2::Hello hello = to_message(session);
    (*hello.mutable_pass())["a_later_metric"] = 1.0;
    (*hello.mutable_pass())["time_s"] = std::nan("");
    EXPECT_EQ(std::get<SessionInfo>(session_info_from(hello)).pass, (PassMarks{{"structure_touches", 0.0}}));
    hello.mutable_plan()->clear_region();
    EXPECT_TRUE(std::holds_alternative<WireError>(session_info_from(hello)));
    hello.mutable_plan()->mutable_sphere()->set_radius_mm(-1.0);
    EXPECT_TRUE(std::holds_alternative<WireError>(session_info_from(hello)));
    hello.mutable_plan()->mutable_sphere()->set_radius_mm(std::nan(""));
    EXPECT_TRUE(std::holds_alternative<WireError>(session_info_from(hello)));
    hello.mutable_plan()->mutable_cylinder()->set_radius_mm(1.0);  // but no length
    EXPECT_TRUE(std::holds_alternative<WireError>(session_info_from(hello)));
    hello.clear_plan();
    EXPECT_FALSE(std::get<SessionInfo>(session_info_from(hello)).plan);
}

TEST(SceneMessages, BringBackTheCutAndSpendNoByteWhereThereIsNone) {
    ToolState tool;
    const std::size_t bytes_without = to_message(tool).ByteSizeLong();
    EXPECT_FALSE(to_message(tool).has_cut());
    EXPECT_FALSE(std::get<ToolState>(tool_from(to_message(tool), 1)).cut);
    tool.cut = {.force_n = 0.5, .tooth_ripple_n = 0.25, .relative_stiffness = 2.0};
    EXPECT_EQ(std::get<ToolState>(tool_from(to_message(tool), 1)).cut, tool.cut);
    tool.cut->loaded_rpm = 0.0;  // a stall
    EXPECT_EQ(std::get<ToolState>(tool_from(to_message(tool), 1)).cut, tool.cut);
    EXPECT_LE(to_message(tool).ByteSizeLong(), bytes_without + 23);
    for (double* number : {&tool.cut->force_n, &tool.cut->tooth_ripple_n, &tool.cut->relative_stiffness,
                           &*tool.cut->loaded_rpm}) {
        const double before = std::exchange(*number, std::nan(""));
        EXPECT_TRUE(std::holds_alternative<WireError>(tool_from(to_message(tool), 1)));
        *number = before;
    }
}

TEST(SceneMessages, BringBackTheLargestForceWhereItIsSaid) {
    ToolState tool;
    EXPECT_FALSE(std::get<ToolState>(tool_from(to_message(tool), 1)).peak_force_n);
    tool.peak_force_n = 2.5;
    EXPECT_FALSE(std::get<ToolState>(tool_from(to_message(tool), 1)).spindle_rpm);
    tool.spindle_rpm = 30'000.0;
    EXPECT_EQ(std::get<ToolState>(tool_from(to_message(tool), 1)).spindle_rpm, 30'000.0);
    EXPECT_EQ(std::get<ToolState>(tool_from(to_message(tool), 1)).peak_force_n, 2.5);
    tool.peak_force_n = std::nan("");
    EXPECT_TRUE(std::holds_alternative<WireError>(tool_from(to_message(tool), 1)));
}

}  // namespace
}  // namespace osteomill
