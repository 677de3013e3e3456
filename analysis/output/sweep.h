// A sweep of many independent cases over several threads.
#pragma once

#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace osteomill::study {

/// Runs the cases 0 to `count` - 1, begun in that order, on `jobs` threads, or on the caller's where they are
/// none or one: `run(i)` by any of them, and `done(i, outcome)` by one at a time, as cases end. What either
/// throws stops the sweep after the cases that are under way, and is thrown here.
template <typename Run, typename Done>
void sweep(std::size_t count, int jobs, Run&& run, Done&& done) {
    std::atomic<std::size_t> next{0};
    std::atomic<bool> is_over{false};
    std::mutex one_at_a_time;
    std::exception_ptr failure;
    const auto work = [&] {
        for (std::size_t i = next++; i < count && !is_over; i = next++) {
            try {
                auto outcome = run(i);
                const std::lock_guard guard(one_at_a_time);
                if (!is_over) done(i, std::move(outcome));
            } catch (...) {
                const std::lock_guard guard(one_at_a_time);
                if (!failure) failure = std::current_exception();
                is_over = true;
            }
        }
    };
    if (jobs <= 1) {
        work();
    } else {
        std::vector<std::jthread> workers;
        for (int i = 0; i < jobs; ++i) workers.emplace_back(work);
    }
    if (failure) std::rethrow_exception(failure);
}

}  // namespace osteomill::study
