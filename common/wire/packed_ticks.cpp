#include "common/wire/packed_ticks.h"

#include <zstd.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "common/session/seen_steps.h"
#include "common/wire/frame.h"
#include "osteomill/v2/session.pb.h"

namespace osteomill {

namespace {

/// A quarter larger than with the level that takes ten times as long.
constexpr int tick_compression_level = 3;
/// The size of most_ticks_of_message ticks if each number takes the longest varint, and space for more
/// quantities.
constexpr std::size_t largest_unpacked_bytes = 64 * 1024;
/// The quantities of protocol 2.2, which every recording with ticks has.
constexpr std::size_t quantities_of_before = 21;

WireError ticks_refused(const std::string& what) {
    return {"packed ticks refused: " + what};
}

/// Differences of hostile codes may exceed the type; they wrap.
std::int64_t sum(std::int64_t a, std::int64_t b) {
    return static_cast<std::int64_t>(static_cast<std::uint64_t>(a) + static_cast<std::uint64_t>(b));
}

bool is_code_of(const TickQuantity& quantity, std::int64_t code, std::size_t burr_count) {
    if (std::abs(static_cast<double>(code)) > largest_decimal_code + 1.0) return false;
    if (quantity.decimals > 0) return true;
    const TickSample largest{.spindle_on = true,
                             .fault = std::numeric_limits<std::uint8_t>::max(),
                             .burr = burr_count - 1,
                             .input = TickInput{.pedal = TickInput::Pedal::no_hand,
                                                .burr = burr_count - 1,
                                                .lets_go = true,
                                                .steps = steps_not_told,
                                                .holds_still = true,
                                                .switched = every_fixture,
                                                .chosen_rpm = std::numeric_limits<std::uint32_t>::max(),
                                                .is_placed = true,
                                                .restored = std::numeric_limits<std::uint32_t>::max()}};
    return code >= 0 && static_cast<double>(code) <= quantity.of(largest);
}

/// Appends the codes of a quantity to those of each tick.
std::optional<WireError> take(const v2::TickQuantities::Quantity& message, const TickQuantity& quantity,
                              std::size_t burr_count, std::vector<TickSample>& ticks) {
    if (static_cast<std::size_t>(message.step_size()) != ticks.size())
        return ticks_refused(std::string(quantity.name) + " is of " + std::to_string(message.step_size()) +
                             " ticks, not of " + std::to_string(ticks.size()));
    std::int64_t code = 0;
    for (std::size_t i = 0; i < ticks.size(); ++i) {
        code = sum(code, message.step(static_cast<int>(i)));
        if (!is_code_of(quantity, code, burr_count))
            return ticks_refused(std::string(quantity.name) + " cannot be " + std::to_string(code));
        quantity.set(ticks[i], from_code(code, quantity.decimals));
    }
    return std::nullopt;
}

bool is_said(const TickQuantity& quantity, std::span<const TickSample> ticks) {
    if (quantity.part != TickPart::control) return quantity.is_of(ticks.front());
    return std::ranges::any_of(ticks, [&](const TickSample& tick) { return quantity.of(tick) != 0.0; });
}

}  // namespace

TickPacker::TickPacker() : compressor_(tick_compression_level) {}

v2::Ticks TickPacker::pack(std::uint64_t missed, std::span<const TickSample> ticks) {
    v2::Ticks message;
    message.set_missed(missed);
    if (ticks.empty()) return message;
    v2::TickQuantities quantities;
    for (const TickQuantity& quantity : tick_quantities()) {
        auto& steps = *quantities.add_quantity()->mutable_step();
        if (!is_said(quantity, ticks)) continue;
        std::int64_t before = 0;
        for (const TickSample& tick : ticks) {
            const std::int64_t code = to_code(quantity.of(tick), quantity.decimals);
            steps.Add(code - before);
            before = code;
        }
    }
    // So a session that nobody controls takes not a byte for it.
    const auto is_empty_control = [&](int last) {
        return tick_quantities()[static_cast<std::size_t>(last)].part == TickPart::control &&
               quantities.quantity(last).step().empty();
    };
    while (is_empty_control(quantities.quantity_size() - 1)) quantities.mutable_quantity()->RemoveLast();
    const std::string content = quantities.SerializeAsString();
    const auto packed =
        compressor_.compress({reinterpret_cast<const std::uint8_t*>(content.data()), content.size()});
    message.set_count(static_cast<std::uint32_t>(ticks.size()));
    message.set_zstd_quantities(packed.data(), packed.size());
    return message;
}

std::variant<TickBlock, WireError> unpack(const v2::Ticks& message, std::size_t burr_count) {
    TickBlock block{.missed = message.missed(), .bytes = message.ByteSizeLong()};
    if (message.count() == 0) return block;
    if (message.count() > most_ticks_of_message)
        return ticks_refused("they are " + std::to_string(message.count()) + ", not 1 to " +
                             std::to_string(most_ticks_of_message));
    const std::string& packed = message.zstd_quantities();
    std::vector<std::uint8_t> content(largest_unpacked_bytes);
    const std::size_t size = ZSTD_decompress(content.data(), content.size(), packed.data(), packed.size());
    if (ZSTD_isError(size)) return ticks_refused(ZSTD_getErrorName(size));
    v2::TickQuantities quantities;
    if (!parse_message(std::span(content).first(size), quantities))
        return ticks_refused("their quantities are no message");
    const auto known = tick_quantities();
    // A newer minor version may know more, an older one less.
    const auto said = static_cast<std::size_t>(quantities.quantity_size());
    if (said < quantities_of_before)
        return ticks_refused("they have " + std::to_string(said) + " quantities, not " +
                             std::to_string(quantities_of_before));
    block.ticks.resize(message.count());
    for (std::size_t i = 0; i < std::min(said, known.size()); ++i) {
        const v2::TickQuantities::Quantity& quantity = quantities.quantity(static_cast<int>(i));
        if (known[i].part != TickPart::always && quantity.step().empty()) continue;
        if (auto error = take(quantity, known[i], burr_count, block.ticks)) return *std::move(error);
    }
    const auto descends = [](const TickSample& a, const TickSample& b) { return a.time_s > b.time_s; };
    if (std::ranges::adjacent_find(block.ticks, descends) != block.ticks.end())
        return ticks_refused("their time goes back");
    return block;
}

}  // namespace osteomill
