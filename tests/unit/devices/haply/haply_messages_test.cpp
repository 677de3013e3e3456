#include "devices/haply/haply_messages.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>

namespace osteomill {
namespace {

/// The documentation's message for version 3.1, shortened, with a wireless grip.
const std::string first_message = R"({
  "inverse3": [{
    "device_id": "04BA",
    "config": {"type": "inverse3", "device_info": {"minor_version": 1, "major_version": 7, "id": "04BA"},
               "port": "COM13", "gravity_compensation": {"enabled": true, "scaling_factor": 1},
               "handedness": "right"},
    "state": {"angular_position": {"a0": -69.31704, "a1": 137.62952, "a2": 19.832787},
              "body_orientation": {"x": -0.01940918, "y": 0.7026367, "z": 0.00048828125, "w": 0.7113037},
              "cursor_position": {"x": 0.07842738, "y": -0.14836666, "z": 0.14297646},
              "cursor_velocity": {"x": -0.011969013, "y": 0.0012009288, "z": -0.043197},
              "mode": "idle"},
    "status": {"calibrated": false, "in_use": false, "power_supply": true, "ready": true, "started": true}
  }],
  "verse_grip": [{"device_id": "61548", "config": {"port": "COM3", "type": "verse_grip"},
    "state": {"button": false, "hall": 0, "orientation": {"x": 0, "y": 0, "z": 1, "w": 0}}}],
  "wireless_verse_grip": [{"device_id": "60001",
    "state": {"orientation": {"w": 0.6, "x": 0.0, "y": 0.8, "z": 0.0},
              "buttons": {"a": true, "b": false, "c": true}}}]})";

nlohmann::json message() {
    return nlohmann::json::parse(first_message);
}

std::optional<HaplyState> parsed(const nlohmann::json& json, std::string_view id = "") {
    return parse_haply_state(json.dump(), id);
}

TEST(HaplyState, IsWhatTheServiceDocuments) {
    const auto state = parse_haply_state(first_message, "");
    ASSERT_TRUE(state && state->arm && state->grip);
    EXPECT_EQ(state->arm->device_id, "04BA");
    EXPECT_EQ(state->arm->position_m, glm::dvec3(0.07842738, -0.14836666, 0.14297646));
    EXPECT_EQ(state->arm->velocity_m_per_s, glm::dvec3(-0.011969013, 0.0012009288, -0.043197));
    EXPECT_EQ(state->arm->is_calibrated, false);
    EXPECT_EQ(state->arm->has_power, true);
    EXPECT_EQ(state->grip->turn, glm::dquat(0.6, 0.0, 0.8, 0.0)) << "the wireless one goes before";
    EXPECT_TRUE(state->grip->button_a && state->grip->button_c);
    EXPECT_FALSE(state->grip->button_b);
    EXPECT_FALSE(state->numbers_session);
    nlohmann::json newer = message();
    newer["session_id"] = 7;
    EXPECT_TRUE(parsed(newer)->numbers_session);
}

TEST(HaplyState, HasTheOneButtonOfAWiredGrip) {
    nlohmann::json wired = message();
    wired.erase("wireless_verse_grip");
    wired["verse_grip"][0]["state"]["button"] = true;
    const auto state = parsed(wired);
    ASSERT_TRUE(state && state->grip);
    EXPECT_TRUE(state->grip->button_a);
    EXPECT_EQ(state->grip->turn, glm::dquat(0.0, 0.0, 0.0, 1.0));
}

TEST(HaplyState, PassesOverAGripThatSaysItIsNotConnected) {
    nlohmann::json asleep = message();
    asleep["wireless_verse_grip"][0]["status"]["connected"] = false;
    EXPECT_EQ(parsed(asleep)->grip->turn, glm::dquat(0.0, 0.0, 0.0, 1.0));
    asleep.erase("verse_grip");
    EXPECT_FALSE(parsed(asleep)->grip);
}

TEST(HaplyState, LeavesOutWhatIsNotThere) {
    nlohmann::json bare = message();
    for (const char* key : {"verse_grip", "wireless_verse_grip"}) bare.erase(key);
    for (const char* key : {"config", "status"}) bare["inverse3"][0].erase(key);
    bare["inverse3"][0]["state"].erase("cursor_velocity");
    const auto state = parsed(bare);
    ASSERT_TRUE(state && state->arm);
    EXPECT_FALSE(state->grip || state->arm->velocity_m_per_s || state->arm->is_calibrated ||
                 state->arm->has_power);
    bare["inverse3"] = nlohmann::json::array();
    ASSERT_TRUE(parsed(bare));
    EXPECT_FALSE(parsed(bare)->arm);
}

TEST(HaplyState, IsOfTheArmThatIsAskedFor) {
    nlohmann::json two = message();
    two["inverse3"].push_back(two["inverse3"][0]);
    two["inverse3"][1]["device_id"] = "0001";
    two["inverse3"][1]["state"]["cursor_position"]["x"] = 0.25;
    EXPECT_EQ(parsed(two, "0001")->arm->position_m.x, 0.25);
    EXPECT_EQ(parsed(two)->arm->device_id, "04BA");
    EXPECT_FALSE(parsed(two, "0002")->arm) << "another is not taken for it";
    two["inverse3"][0] = "broken";
    EXPECT_EQ(parsed(two, "0001")->arm->position_m.x, 0.25) << "what the other says is no matter";
}

TEST(HaplyState, IsNoneWhereTheArmSaysNothingOfSense) {
    const auto with = [](const nlohmann::json& patch) {
        nlohmann::json broken = message();
        broken["inverse3"][0].merge_patch(patch);
        return parsed(broken);
    };
    const auto at = [&](const nlohmann::json& position) {
        return with({{"state", {{"cursor_position", position}}}});
    };
    ASSERT_TRUE(at({{"x", 0}}));
    EXPECT_FALSE(at({{"x", "0"}}));
    EXPECT_FALSE(at({{"y", true}}));
    EXPECT_FALSE(at({{"z", nullptr}})) << "merging null erases it";
    EXPECT_FALSE(at({{"x", 1e300}}));
    EXPECT_FALSE(at({{"x", -5.1}}));
    EXPECT_FALSE(at(nullptr));
    EXPECT_FALSE(at(nlohmann::json::array({0, 0, 0})));
    EXPECT_FALSE(with({{"state", nullptr}}));
    EXPECT_FALSE(with({{"state", 7}}));
    EXPECT_FALSE(with({{"device_id", nullptr}}));
    EXPECT_FALSE(with({{"device_id", 49}}));
    EXPECT_FALSE(with({{"device_id", ""}}));
    EXPECT_FALSE(with({{"device_id", "a\"b"}})) << "it is sent back as it came";
    EXPECT_FALSE(with({{"device_id", std::string(65, 'A')}}));
    ASSERT_TRUE(with({{"state", {{"cursor_velocity", {{"x", "fast"}}}}}}));
    EXPECT_FALSE(with({{"state", {{"cursor_velocity", {{"x", "fast"}}}}}})->arm->velocity_m_per_s);
}

TEST(HaplyState, IsNoneWhereTheGripSaysNothingOfSense) {
    const auto turned = [](const nlohmann::json& w) {
        nlohmann::json broken = message();
        broken["wireless_verse_grip"][0]["state"]["orientation"] = {{"w", w}, {"x", 0}, {"y", 0}, {"z", 0}};
        return parsed(broken);
    };
    ASSERT_TRUE(turned(1.05));
    EXPECT_EQ(turned(1.05)->grip->turn, glm::dquat(1.0, 0.0, 0.0, 0.0));
    EXPECT_FALSE(turned(0.0));
    EXPECT_FALSE(turned(1e200));
    EXPECT_FALSE(turned("1"));
    nlohmann::json odd = message();
    odd["wireless_verse_grip"][0]["state"]["buttons"] = {{"a", 1}, {"b", "true"}};
    EXPECT_FALSE(parsed(odd)->grip->button_a || parsed(odd)->grip->button_b);
}

TEST(HaplyState, IsNoneOfGarbage) {
    for (const char* text :
         {"", " ", "null", "7", "[]", "\"inverse3\"", "{", "{}", R"({"inverse3":7})", R"({"inverse3":{}})",
          R"({"inverse3":[null]})",
          R"({"inverse3":[{"device_id":"A","state":{"cursor_position":{"x":NaN}}}]})",
          R"({"inverse3":[{"device_id":"A","state":{"cursor_position":{"x":1e999,"y":0,"z":0}}}]})",
          "\xff\xfe{\"inverse3\":[]}", "GET / HTTP/1.1\r\n\r\n"})
        EXPECT_FALSE(parse_haply_state(text, "")) << text;
    EXPECT_FALSE(parse_haply_state(std::string(200'000, '['), ""));
    EXPECT_FALSE(parse_haply_state(std::string(100'000, '[') + std::string(100'000, ']'), ""));
    std::string nested = R"({"inverse3":[],"x":)";
    for (int i = 0; i < 50'000; ++i) nested += R"({"x":)";
    EXPECT_FALSE(parse_haply_state(nested, ""));
    EXPECT_FALSE(parse_haply_state(nested + "0" + std::string(50'001, '}'), ""))
        << "deeper than any service's";
    std::string known_by_nobody = R"({"inverse3":[],"x":)";
    for (int i = 0; i < 50; ++i) known_by_nobody += R"({"x":)";
    EXPECT_TRUE(parse_haply_state(known_by_nobody + "0" + std::string(51, '}'), "")) << "no arm, read over";
    std::string many = R"({"inverse3":[)";
    for (int i = 0; i < 5'000; ++i) many += "{},";
    EXPECT_FALSE(parse_haply_state(many + "{}]}", ""));
}

TEST(HaplyState, ComesOfNothingCutOffOrChanged) {
    for (std::size_t size = 0; size < first_message.size(); ++size)
        EXPECT_FALSE(parse_haply_state(std::string_view(first_message).substr(0, size), "")) << size;
    std::mt19937 random(22);
    for (int i = 0; i < 20'000; ++i) {
        std::string changed = first_message;
        for (int flips = 0; flips < 3; ++flips)
            changed[random() % changed.size()] = static_cast<char>(random());
        const auto state = parse_haply_state(changed, "");
        if (!state || !state->arm) continue;
        EXPECT_TRUE(std::isfinite(state->arm->position_m.x + state->arm->position_m.y));
        EXPECT_LE(std::abs(state->arm->position_m.z), farthest_m);
        EXPECT_EQ(state->arm->device_id.find('"'), std::string::npos);
        if (!state->grip) continue;
        EXPECT_NEAR(glm::length(state->grip->turn), 1.0, 1e-12);
    }
}

TEST(HaplyForce, IsWhatTheServiceDocuments) {
    std::string text = "what was there";
    write_haply_force(text, "049D", {0.5, -1.25, 1e-9}, HaplyForceField::values);
    EXPECT_EQ(text, R"({"inverse3":[{"device_id":"049D","commands":{"set_cursor_force":{"values":)"
                    R"({"x":0.500000,"y":-1.250000,"z":0.000000}}}}]})");
    const auto read = nlohmann::json::parse(text);
    EXPECT_EQ(read["inverse3"][0]["commands"]["set_cursor_force"]["values"]["y"], -1.25);
    write_haply_force(text, "049D", {0.0, 0.0, 0.0}, HaplyForceField::vector);
    EXPECT_TRUE(
        nlohmann::json::parse(text)["inverse3"][0]["commands"]["set_cursor_force"].contains("vector"));
}

TEST(HaplyForce, IsZeroWhereItIsNoNumber) {
    std::string text;
    const double infinite = std::numeric_limits<double>::infinity();
    write_haply_force(text, "A", {std::nan(""), infinite, -infinite}, HaplyForceField::values);
    EXPECT_THAT(text, ::testing::HasSubstr(R"({"x":0.000000,"y":0.000000,"z":0.000000})"));
}

TEST(HaplyQuestion, IsJson) {
    EXPECT_TRUE(nlohmann::json::parse(haply_question).contains("session"));
}

}  // namespace
}  // namespace osteomill
