// The milling steps whose result a tick was the first to see, as one whole number. It records the order in
// which the loops of the real clock took turns, so that a session can be computed again as it was.
//
// Each run of steps to one command is a field of 16 bits, the oldest run in the lowest: count + 32 * lag +
// 512 * missed. `count` steps (1 to 31) went to the command of the tick `lag` before (1 to 15), the first of
// them after `missed` skipped periods of its loop (0 to 127).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace osteomill {

/// Steps of the milling loop to the command of one tick. Only before the first of them were periods skipped.
struct StepRun {
    std::uint64_t command = 0;
    std::uint64_t missed = 0;
    std::uint64_t count = 0;
};

/// One of them.
struct StepTrace {
    std::uint64_t command = 0;
    std::uint64_t missed = 0;

    bool operator==(const StepTrace&) const = default;
};

/// Runs that a milling loop remembers; a number holds one less.
inline constexpr std::size_t newest_step_runs = 4;
inline constexpr std::uint64_t step_run_digit = 65536;
/// There were more, or they were too late for a number to hold.
inline constexpr std::uint64_t steps_not_told = step_run_digit * step_run_digit * step_run_digit;

/// `runs` are those that `tick` is the first to see, in order. Real-time safe.
inline std::uint64_t code_of_steps(std::span<const StepRun> runs, std::uint64_t tick) noexcept {
    constexpr std::uint64_t most_count = 31;
    constexpr std::uint64_t most_lag = 15;
    constexpr std::uint64_t most_missed = 127;
    std::array<std::uint64_t, newest_step_runs - 1> digits{};
    std::size_t used = 0;
    for (StepRun run : runs) {
        const std::uint64_t lag = tick - run.command;
        if (lag < 1 || lag > most_lag || run.missed > most_missed) return steps_not_told;
        for (; run.count > 0; run.missed = 0) {
            if (used == digits.size()) return steps_not_told;
            const std::uint64_t count = std::min(run.count, most_count);
            digits[used++] = count + 32 * lag + 512 * run.missed;
            run.count -= count;
        }
    }
    std::uint64_t code = 0;
    for (std::size_t i = used; i > 0; --i) code = step_run_digit * code + digits[i - 1];
    return code;
}

/// Nothing if the number holds no steps, or cannot be valid.
inline std::optional<std::vector<StepTrace>> steps_of_code(std::uint64_t code, std::uint64_t tick) {
    if (code >= steps_not_told) return std::nullopt;
    std::vector<StepTrace> steps;
    for (; code > 0; code /= step_run_digit) {
        const std::uint64_t digit = code % step_run_digit;
        const std::uint64_t count = digit % 32;
        const std::uint64_t lag = digit / 32 % 16;
        if (count == 0 || lag == 0 || lag > tick) return std::nullopt;
        for (std::uint64_t i = 0; i < count; ++i)
            steps.push_back({.command = tick - lag, .missed = i == 0 ? digit / 512 : 0});
    }
    return steps;
}

}  // namespace osteomill
