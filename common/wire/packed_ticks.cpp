#include "common/wire/packed_ticks.h"

#include <zstd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "common/wire/parse_message.h"

namespace osteomill {

namespace {

/// A quarter larger than what takes ten times as long.
constexpr int tick_compression_level = 3;
/// Of most_ticks_of_message where each number takes the longest varint, with room for more quantities.
constexpr std::size_t largest_unpacked_bytes = 64 * 1024;
/// Codes up to here, and what lies between two of them, are exact in a double.
constexpr double largest_code = 1e15;

constexpr std::array powers_of_ten{1.0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9};

WireError ticks_refused(const std::string& what) {
    return {"packed ticks refused: " + what};
}

/// Differences of hostile codes may exceed the type; they wrap.
std::int64_t sum(std::int64_t a, std::int64_t b) {
    return static_cast<std::int64_t>(static_cast<std::uint64_t>(a) + static_cast<std::uint64_t>(b));
}

bool is_code_of(const TickQuantity& quantity, std::int64_t code, std::size_t burr_count) {
    if (std::abs(static_cast<double>(code)) > largest_code + 1.0) return false;
    if (quantity.decimals > 0) return true;
    const TickSample largest{
        .spindle_on = true, .fault = std::numeric_limits<std::uint8_t>::max(), .burr = burr_count - 1};
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

}  // namespace

std::int64_t to_code(double value, int decimals) {
    const double magnitude = std::abs(value);
    const double scale = powers_of_ten[static_cast<std::size_t>(decimals)];
    double whole = std::floor(magnitude * scale);
    // The sign is that of the exact value, although the product was rounded.
    const double beyond_half = std::fma(magnitude, scale, -(whole + 0.5));
    if (beyond_half > 0.0 || (beyond_half == 0.0 && std::fmod(whole, 2.0) == 1.0)) whole += 1.0;
    if (!(whole < largest_code)) whole = largest_code;
    const auto code = static_cast<std::int64_t>(whole);
    return std::signbit(value) ? ~code : code;
}

double from_code(std::int64_t code, int decimals) {
    const double scale = powers_of_ten[static_cast<std::size_t>(decimals)];
    return code < 0 ? -(static_cast<double>(~code) / scale) : static_cast<double>(code) / scale;
}

TickPacker::TickPacker() : compressor_(tick_compression_level) {}

v2::Ticks TickPacker::pack(std::uint64_t missed, std::span<const TickSample> ticks) {
    v2::Ticks message;
    message.set_missed(missed);
    if (ticks.empty()) return message;
    v2::TickQuantities quantities;
    const auto said = tick_quantities(ticks.front().shank_torque_n_mm.has_value());
    for (const TickQuantity& quantity : tick_quantities()) {
        auto& steps = *quantities.add_quantity()->mutable_step();
        if (static_cast<std::size_t>(quantities.quantity_size()) > said.size()) continue;
        std::int64_t before = 0;
        for (const TickSample& tick : ticks) {
            const std::int64_t code = to_code(quantity.of(tick), quantity.decimals);
            steps.Add(code - before);
            before = code;
        }
    }
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
    // A newer minor version may know more.
    if (static_cast<std::size_t>(quantities.quantity_size()) < known.size())
        return ticks_refused("they have " + std::to_string(quantities.quantity_size()) + " quantities, not " +
                             std::to_string(known.size()));
    block.ticks.resize(message.count());
    for (std::size_t i = 0; i < known.size(); ++i) {
        const v2::TickQuantities::Quantity& quantity = quantities.quantity(static_cast<int>(i));
        const bool may_be_absent = i + torque_quantities >= known.size();
        if (may_be_absent && quantity.step().empty()) continue;
        if (auto error = take(quantity, known[i], burr_count, block.ticks)) return *std::move(error);
    }
    const auto descends = [](const TickSample& a, const TickSample& b) { return a.time_s > b.time_s; };
    if (std::ranges::adjacent_find(block.ticks, descends) != block.ticks.end())
        return ticks_refused("their time goes back");
    return block;
}

}  // namespace osteomill
