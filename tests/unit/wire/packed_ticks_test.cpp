#include "common/wire/packed_ticks.h"

#include <gmock/gmock.h>
#include <zstd.h>

#include <random>

#include "common/session/seen_steps.h"
#include "common/session/written_pose.h"
#include "common/wire/frame.h"
#include "osteomill/v2/session.pb.h"

namespace osteomill {
namespace {

using ::testing::HasSubstr;

std::string line_of(const TickSample& tick) {
    fmt::memory_buffer text;
    tick.append_to(text);
    return {text.data(), text.size()};
}

glm::dvec3 vector_of(std::mt19937& random, double largest) {
    std::uniform_real_distribution<double> of(-largest, largest);
    return {of(random), of(random), of(random)};
}

TickSample tick_of(std::mt19937& random, double time_s, bool has_torque) {
    TickSample tick{.time_s = time_s,
                    .hand_mm = vector_of(random, 100.0),
                    .burr_mm = vector_of(random, 1e-4),  // of either sign, and many of them minus zero
                    .force_n = vector_of(random, 3.0),
                    .depth_mm = vector_of(random, 1.0).x,
                    .removed_mm3 = 1e4 * time_s,
                    .spindle_on = random() % 2 == 0,
                    .fault = static_cast<std::uint8_t>(random() % 9),
                    .spindle_axis = vector_of(random, 1.0),
                    .burr = random() % 3};
    if (has_torque) tick.shank_torque_n_mm = vector_of(random, 50.0);
    return tick;
}

std::vector<TickSample> ticks_of(std::mt19937& random, std::size_t count, bool has_torque) {
    std::vector<TickSample> ticks;
    for (std::size_t i = 0; i < count; ++i)
        ticks.push_back(tick_of(random, 0.001 * static_cast<double>(i), has_torque));
    return ticks;
}

v2::Ticks packed_by_hand(const v2::TickQuantities& quantities, std::uint32_t count) {
    const std::string content = quantities.SerializeAsString();
    std::string packed(ZSTD_compressBound(content.size()), '\0');
    packed.resize(ZSTD_compress(packed.data(), packed.size(), content.data(), content.size(), 1));
    v2::Ticks message;
    message.set_count(count);
    message.set_zstd_quantities(packed);
    return message;
}

/// A tick as the haptic loop leaves it: its hand is written exactly.
TickSample input_tick_of(std::mt19937& random, std::uint64_t number) {
    TickSample tick = tick_of(random, 0.001 * static_cast<double>(number), false);
    const ToolPose hand = as_written({tick.hand_mm, tick.spindle_axis});
    tick.hand_mm = hand.position_mm;
    tick.spindle_axis = hand.spindle_axis;
    tick.input = TickInput{.pedal = static_cast<TickInput::Pedal>(random() % 5),
                           .lets_go = random() % 2 == 0,
                           .steps = random() % steps_not_told,
                           .holds_still = random() % 2 == 0,
                           .switched = static_cast<FixtureSet>(random() & every_fixture),
                           .chosen_rpm = static_cast<std::uint32_t>(random() % 500'001),
                           .is_placed = random() % 2 == 0,
                           .restored = static_cast<std::uint32_t>(random() % 41)};
    if (random() % 2 == 0) tick.input->burr = random() % 3;
    return tick;
}

/// The quantities of one tick at rest, as a reader of the protocol's page would make them.
v2::TickQuantities at_rest() {
    v2::TickQuantities quantities;
    for (int i = 0; i < 18; ++i) quantities.add_quantity()->add_step(0);
    for (int i = 0; i < 3; ++i) quantities.add_quantity();
    return quantities;
}

std::string error_of(const v2::Ticks& message) {
    const auto unpacked = unpack(message, 3);
    const auto* error = std::get_if<WireError>(&unpacked);
    return error != nullptr ? error->line : "";
}

TEST(PackedTicks, HaveTheHandAndItsInputExactly) {
    std::mt19937 random(3);
    std::vector<TickSample> ticks;
    for (std::uint64_t i = 0; i < most_ticks_of_message; ++i) ticks.push_back(input_tick_of(random, i));
    // Half way between two numbers of the fourth decimal, at which two roundings must not differ.
    ticks[3].hand_mm = {0.00005, -0.00015, 12.34565};
    ticks[4].hand_mm = {-0.0, 0.0, -0.000001};
    TickPacker packer;
    const auto unpacked = unpack(packer.pack(0, ticks), 3);
    const auto* block = std::get_if<TickBlock>(&unpacked);
    ASSERT_NE(block, nullptr) << std::get<WireError>(unpacked).line;
    for (std::size_t i = 0; i < ticks.size(); ++i) {
        EXPECT_EQ(block->ticks[i].hand_mm, ticks[i].hand_mm) << i;
        EXPECT_EQ(block->ticks[i].spindle_axis, ticks[i].spindle_axis) << i;
        EXPECT_EQ(block->ticks[i].input, ticks[i].input) << i;
        EXPECT_EQ(line_of(block->ticks[i]), line_of(ticks[i])) << i;
    }
}

TEST(PackedTicks, SpendNoByteOnControlsThatNobodyUsed) {
    std::mt19937 random(3);
    std::vector<TickSample> ticks;
    for (std::uint64_t i = 0; i < most_ticks_of_message; ++i) {
        ticks.push_back(input_tick_of(random, i));
        const TickInput& input = *ticks.back().input;
        ticks.back().input = TickInput{
            .pedal = input.pedal, .burr = input.burr, .lets_go = input.lets_go, .steps = input.steps};
    }
    const auto quantities_of = [](const v2::Ticks& message) {
        std::vector<char> content(1 << 16);
        const std::string& packed = message.zstd_quantities();
        content.resize(ZSTD_decompress(content.data(), content.size(), packed.data(), packed.size()));
        v2::TickQuantities quantities;
        EXPECT_TRUE(quantities.ParseFromArray(content.data(), static_cast<int>(content.size())));
        return quantities.quantity_size();
    };
    TickPacker packer;
    const int usual = quantities_of(packer.pack(0, ticks));
    EXPECT_EQ(usual, static_cast<int>(tick_quantities().size()) - 5);
    ticks[5].input->holds_still = true;
    EXPECT_EQ(quantities_of(packer.pack(0, ticks)), usual + 1);
    ticks[5].input->holds_still = false;
    ticks[6].input->switched = 0b10;
    EXPECT_EQ(quantities_of(packer.pack(0, ticks)), usual + 2);
    ticks[7].input->restored = 3;
    EXPECT_EQ(quantities_of(packer.pack(0, ticks)), usual + 5);
}

TEST(PackedTicks, OfBeforeHaveNoInput) {
    const auto unpacked = unpack(packed_by_hand(at_rest(), 1), 3);
    EXPECT_FALSE(std::get<TickBlock>(unpacked).ticks.at(0).input);
}

TEST(PackedTicks, HaveTheNumbersOfALogToTheDigit) {
    EXPECT_EQ(to_code(1.23456, 4), 12346);
    EXPECT_EQ(to_code(0.0, 4), 0);
    EXPECT_EQ(to_code(-0.0, 4), -1);
    EXPECT_EQ(to_code(-0.00004, 4), -1) << "a log says -0.0000";
    EXPECT_EQ(to_code(-0.0001, 4), -2);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> exponent(-9.0, 8.0);
    for (int i = 0; i < 200'000; ++i) {
        const int decimals = i % 7;
        double value = std::pow(10.0, exponent(random));
        // Every other lies half way between two numbers of the last decimal, or next to that.
        if (i % 2 == 0) {
            value = (std::floor(value * 64.0) + 0.5) / 64.0;
            if (i % 4 == 0) value = std::nextafter(value, i % 8 == 0 ? 0.0 : 1e9);
        }
        if (random() % 2 == 0) value = -value;
        const std::string digits = fmt::format("{:.{}f}", value, decimals);
        ASSERT_EQ(fmt::format("{:.{}f}", from_code(to_code(value, decimals), decimals), decimals), digits);
    }
}

TEST(PackedTicks, MakeTheLinesOfTheTicksThatWerePacked) {
    std::mt19937 random(3);
    TickPacker packer;
    for (const bool has_torque : {false, true})
        for (const std::size_t count : {std::size_t{1}, std::size_t{33}, most_ticks_of_message}) {
            std::vector<TickSample> ticks = ticks_of(random, count, has_torque);
            for (TickSample& tick : ticks) tick.input.emplace();  // without, as older programs, four decimals
            v2::Ticks arrived;
            ASSERT_TRUE(arrived.ParseFromString(packer.pack(5, ticks).SerializeAsString()));
            const auto unpacked = unpack(arrived, 3);
            ASSERT_TRUE(std::holds_alternative<TickBlock>(unpacked)) << std::get<WireError>(unpacked).line;
            const auto& block = std::get<TickBlock>(unpacked);
            EXPECT_EQ(block.missed, 5U);
            ASSERT_EQ(block.ticks.size(), count);
            for (std::size_t i = 0; i < count; ++i) {
                EXPECT_EQ(line_of(block.ticks[i]), line_of(ticks[i]));
                EXPECT_EQ(block.ticks[i].burr, ticks[i].burr);
                for (int axis = 0; axis < 3; ++axis)
                    EXPECT_NEAR(block.ticks[i].spindle_axis[axis], ticks[i].spindle_axis[axis], 0.5000001e-6);
            }
        }
}

TEST(PackedTicks, FitAFrameBesideTheLargestChangesWhateverTheyAre) {
    std::vector<TickSample> ticks(most_ticks_of_message);
    std::mt19937 random(5);
    for (TickSample& tick : ticks) {
        tick = tick_of(random, 0.0, true);
        for (glm::dvec3* vector : {&tick.hand_mm, &tick.burr_mm, &tick.force_n, &tick.spindle_axis})
            *vector = vector_of(random, 1e300);
        tick.shank_torque_n_mm = vector_of(random, 1e300);
        tick.depth_mm = std::numeric_limits<double>::quiet_NaN();
    }
    const v2::Ticks message = TickPacker().pack(0, ticks);
    EXPECT_LT(message.ByteSizeLong(), largest_frame_bytes / 4);
    EXPECT_EQ(error_of(message), "");
}

TEST(PackedTicks, SayWhatIsMissingWithoutAny) {
    const auto unpacked = unpack(TickPacker().pack(7, {}), 1);
    EXPECT_EQ(std::get<TickBlock>(unpacked).missed, 7U);
    EXPECT_TRUE(std::get<TickBlock>(unpacked).ticks.empty());
}

TEST(PackedTicks, AreRefusedWhereTheyDoNotAddUp) {
    EXPECT_EQ(error_of(packed_by_hand(at_rest(), 1)), "");
    EXPECT_THAT(error_of(packed_by_hand(at_rest(), 2)), HasSubstr("t_s is of 1 ticks, not of 2"));
    EXPECT_THAT(error_of(packed_by_hand(at_rest(), 129)), HasSubstr("they are 129, not 1 to 128"));
    const auto with = [](int quantity, std::int64_t step) {
        v2::TickQuantities quantities = at_rest();
        quantities.mutable_quantity(quantity)->set_step(0, step);
        return error_of(packed_by_hand(quantities, 1));
    };
    EXPECT_EQ(with(17, 2), "");
    EXPECT_THAT(with(17, 3), HasSubstr("burr cannot be 3"));
    EXPECT_THAT(with(17, -1), HasSubstr("burr cannot be -1"));
    EXPECT_THAT(with(12, 2), HasSubstr("spindle cannot be 2"));
    EXPECT_THAT(with(13, 256), HasSubstr("fault cannot be 256"));
    EXPECT_THAT(with(1, std::numeric_limits<std::int64_t>::min()), HasSubstr("hand_x_mm cannot be"));
    v2::TickQuantities fewer = at_rest();
    fewer.mutable_quantity()->RemoveLast();
    EXPECT_THAT(error_of(packed_by_hand(fewer, 1)), HasSubstr("20 quantities, not 21"));
    v2::TickQuantities newer = at_rest();
    newer.add_quantity()->add_step(1);
    EXPECT_EQ(error_of(packed_by_hand(newer, 1)), "") << "a newer version may know more";
    v2::TickQuantities back;
    for (int i = 0; i < 21; ++i) {
        auto& quantity = *back.add_quantity();
        quantity.add_step(i == 0 ? 5 : 0);
        quantity.add_step(i == 0 ? -1 : 0);
    }
    EXPECT_THAT(error_of(packed_by_hand(back, 2)), HasSubstr("their time goes back"));
    v2::Ticks message;
    message.set_count(1);
    message.set_zstd_quantities("no zstd");
    EXPECT_THAT(error_of(message), HasSubstr("refused"));
    v2::TickQuantities bomb;
    for (int i = 0; i < 100'000; ++i) bomb.add_quantity();
    EXPECT_THAT(error_of(packed_by_hand(bomb, 1)), HasSubstr("refused"));
}

}  // namespace
}  // namespace osteomill
