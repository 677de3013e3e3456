#include "python/module/session_motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <mutex>
#include <span>
#include <stdexcept>
#include <string>
#include <thread>
#include <unordered_set>

#include "common/bone/patient_space.h"
#include "common/session/session_control.h"
#include "python/module/arrays.h"
#include "python/module/released_lock.h"
#include "python/module/tick_columns.h"

namespace osteomill::python {

namespace {

constexpr std::uint64_t ticks_between_signals = 1000;
constexpr auto most_ms = static_cast<std::int64_t>(1000.0 * longest_session_s);

}  // namespace

void raise_of_signal() {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

glm::dvec3 place_of(const py::handle& value, const char* argument) {
    const glm::dvec3 place_mm = vector_of(value, argument);
    if (!is_place(place_mm))
        throw std::invalid_argument(
            fmt::format("{}: lies more than {} mm from the origin", argument, farthest_place_mm));
    return place_mm;
}

namespace {

std::int32_t burr_number(const SteppedSession& session, const py::object& burr) {
    if (burr.is_none()) return -1;
    const std::vector<Burr>& burrs = session.loaded().settings().burrs;
    if (py::isinstance<py::str>(burr)) {
        const auto name = burr.cast<std::string>();
        for (std::size_t i = 0; i < burrs.size(); ++i)
            if (burrs[i].name == name) return static_cast<std::int32_t>(i);
        throw std::invalid_argument(fmt::format("burr: \"{}\" is none of Case.burrs", name));
    }
    const auto number = burr.cast<std::int64_t>();
    if (number < 0 || number >= static_cast<std::int64_t>(burrs.size()))
        throw std::invalid_argument(fmt::format("burr: {} is none of the case's {}", number, burrs.size()));
    return static_cast<std::int32_t>(number);
}

/// N rows of three. Throws std::invalid_argument for another shape and for values that are not finite.
void require_rows(const Doubles& rows, py::ssize_t n, const char* argument) {
    if (rows.ndim() != 2 || rows.shape(0) != n || rows.shape(1) != 3)
        throw std::invalid_argument(fmt::format("{}: takes an array ({}, 3), not {}", argument, n,
                                                std::string(py::str(rows.attr("shape")))));
    for (py::ssize_t i = 0; i < rows.size(); ++i)
        if (!std::isfinite(rows.data()[i]))
            throw std::invalid_argument(fmt::format("{}: row {} is not finite", argument, i / 3));
}

glm::dvec3 row(const Doubles& rows, py::ssize_t i) {
    const double* at = rows.data() + 3 * i;
    return {at[0], at[1], at[2]};
}

}  // namespace

void require_prescribed(const SteppedSession& session, const char* what) {
    if (session.has_simulated_hand())
        throw std::invalid_argument(fmt::format(
            "{}: the simulated hand goes its own way; make the session with hand=\"prescribed\"", what));
}

std::vector<HandInput> inputs_of(const SteppedSession& session, const Doubles& hands,
                                 const std::optional<Doubles>& axes, const std::optional<Flags>& pedals,
                                 std::int32_t burr) {
    const py::ssize_t n = hands.ndim() > 0 ? hands.shape(0) : 0;
    require_rows(hands, n, "hands");
    const bool one_axis = axes && axes->ndim() == 1;
    if (axes && !one_axis) require_rows(*axes, n, "axes");
    if (pedals && pedals->ndim() != 0 && (pedals->ndim() != 1 || pedals->shape(0) != n))
        throw std::invalid_argument(fmt::format("pedals: takes one flag, or an array ({},)", n));
    HandInput input{.pose = session.hand(), .burr = burr};
    if (one_axis) input.pose.spindle_axis = unit(vector_of(*axes, "axes"), "axes");
    std::vector<HandInput> inputs(static_cast<std::size_t>(n), input);
    for (py::ssize_t i = 0; i < n; ++i) {
        HandInput& at = inputs[static_cast<std::size_t>(i)];
        at.pose.position_mm = row(hands, i);
        if (!is_place(at.pose.position_mm))
            throw std::invalid_argument(
                fmt::format("hands: row {} lies more than {} mm from the origin", i, farthest_place_mm));
        if (axes && !one_axis) at.pose.spindle_axis = unit(row(*axes, i), "axes");
        if (pedals) at.pedal = pedals->data()[pedals->ndim() == 0 ? 0 : i];
    }
    return inputs;
}

Tick step(const SharedSession& session, const py::object& hand_mm, const py::object& axis, bool pedal,
          const py::object& burr, std::int64_t ms) {
    if (ms < 1 || ms > most_ms)
        throw std::invalid_argument(
            fmt::format("ms: takes whole milliseconds from 1 to {}, not {}", most_ms, ms));
    const std::unique_lock<std::mutex> held = taken(session->busy());
    HandInput input{.pose = session->hand(),
                    .pedal = pedal,
                    .burr = burr_number(*session, burr),
                    .ticks = static_cast<std::uint64_t>(ms)};
    if (!hand_mm.is_none() || !axis.is_none() || pedal || input.burr >= 0)
        require_prescribed(*session, "hand_mm, axis, pedal, burr");
    if (!hand_mm.is_none()) input.pose.position_mm = place_of(hand_mm, "hand_mm");
    if (!axis.is_none()) input.pose.spindle_axis = unit(vector_of(axis, "axis"), "axis");
    for (std::uint64_t left = input.ticks; left > 0; left -= input.ticks) {
        input.ticks = std::min(left, ticks_between_signals);
        {
            const ReleasedLock released;
            session->step(input);
        }
        raise_of_signal();
    }
    return {session->state(), session->loaded()};
}

py::dict rollout(const SharedSession& session, const Doubles& hands, const std::optional<Doubles>& axes,
                 const std::optional<Flags>& pedals, const py::object& burr) {
    const std::unique_lock<std::mutex> held = taken(session->busy());
    require_prescribed(*session, "rollout");
    const std::vector<HandInput> inputs =
        inputs_of(*session, hands, axes, pedals, burr_number(*session, burr));
    TickColumns columns(session->loaded(), inputs.size());
    for (std::span<const HandInput> left = inputs; !left.empty();) {
        const auto now = left.first(std::min<std::size_t>(left.size(), ticks_between_signals));
        {
            const ReleasedLock released;
            for (const HandInput& input : now) {
                session->step(input);
                columns.add(*session);
            }
        }
        raise_of_signal();
        left = left.subspan(now.size());
    }
    return dict_of(std::move(columns), session->loaded());
}

py::dict run(const SharedSession& session, std::int64_t ms) {
    if (ms < 0 || ms > most_ms)
        throw std::invalid_argument(
            fmt::format("ms: takes whole milliseconds up to {}, not {}", most_ms, ms));
    const std::unique_lock<std::mutex> held = taken(session->busy());
    HandInput input{.pose = session->hand()};
    TickColumns columns(session->loaded(), static_cast<std::size_t>(ms));
    for (std::int64_t tick = 0; tick < ms && !session->is_finished();) {
        {
            const ReleasedLock released;
            const std::int64_t until = std::min(ms, tick + static_cast<std::int64_t>(ticks_between_signals));
            for (; tick < until && !session->is_finished(); ++tick) {
                session->step(input);
                columns.add(*session);
            }
        }
        raise_of_signal();
    }
    return dict_of(std::move(columns), session->loaded());
}

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
