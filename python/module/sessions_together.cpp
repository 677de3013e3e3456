#include "python/module/sessions_together.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <unordered_set>

#include "python/module/arrays.h"
#include "python/module/released_lock.h"

namespace osteomill::python {

namespace {

/// Calls `work` with each number below `count`, in so many threads, this among them. The first exception, by
/// number, is thrown once all is done.
template <typename Work>
void for_each_number(std::size_t count, std::size_t threads, const Work& work) {
    std::atomic<std::size_t> next{0};
    std::vector<std::exception_ptr> thrown(count);
    const auto take = [&] {
        for (std::size_t i = next.fetch_add(1); i < count; i = next.fetch_add(1)) {
            try {
                work(i);
            } catch (...) {
                thrown[i] = std::current_exception();
            }
        }
    };
    {
        std::vector<std::jthread> others;
        for (std::size_t i = 1; i < std::min(threads, count); ++i) others.emplace_back(take);
        take();
    }
    for (const std::exception_ptr& one : thrown)
        if (one) std::rethrow_exception(one);
}

}  // namespace

std::vector<Tick> step_together(const std::vector<SharedSession>& sessions, const std::vector<Doubles>& hands,
                                const std::vector<std::optional<Doubles>>& axes,
                                const std::vector<Flags>& pedals, int threads) {
    const std::size_t count = sessions.size();
    if (hands.size() != count || axes.size() != count || pedals.size() != count)
        throw std::invalid_argument(
            fmt::format("hands, axes, pedals: take one for each of the {} sessions, not {}, {} and {}", count,
                        hands.size(), axes.size(), pedals.size()));
    if (threads < 1) throw std::invalid_argument(fmt::format("threads: takes 1 or more, not {}", threads));
    if (std::unordered_set<SharedSession>(sessions.begin(), sessions.end()).size() != count)
        throw std::invalid_argument("sessions: one of them is there twice");
    std::vector<std::unique_lock<std::mutex>> held;
    std::vector<std::vector<HandInput>> inputs;
    for (std::size_t i = 0; i < count; ++i) {
        held.push_back(taken(sessions[i]->busy()));
        require_prescribed(*sessions[i], "hands");
        inputs.push_back(inputs_of(*sessions[i], hands[i], axes[i], pedals[i], -1));
        if (sessions[i]->has_ended()) throw std::logic_error("a session has ended; make another");
    }
    {
        const ReleasedLock released;
        for_each_number(count, static_cast<std::size_t>(threads), [&](std::size_t i) {
            for (const HandInput& input : inputs[i]) sessions[i]->step(input);
        });
    }
    raise_of_signal();
    std::vector<Tick> ticks;
    ticks.reserve(count);
    for (const SharedSession& session : sessions) ticks.emplace_back(session->state(), session->loaded());
    return ticks;
}

}  // namespace osteomill::python
