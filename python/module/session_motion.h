// Motion of sessions by Python's arguments: a step, a rollout, a run, or many sessions at once.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "python/module/stepped_session.h"
#include "python/module/tick_bindings.h"

namespace osteomill::python {

using SharedSession = std::shared_ptr<SteppedSession>;
using Doubles = pybind11::array_t<double, pybind11::array::c_style | pybind11::array::forcecast>;
using Flags = pybind11::array_t<bool, pybind11::array::c_style | pybind11::array::forcecast>;

// Errors are std::invalid_argument for an argument, named in the line, and std::runtime_error for a session
// that another thread holds. Python's signals end the work within a second of session time.

/// Raises the exceptions of Python's signals, such as Ctrl-C: they wait for the interpreter's lock.
void raise_of_signal();

/// A place of three numbers, patient LPS, mm.
glm::dvec3 place_of(const pybind11::handle& value, const char* argument);

/// Throws std::invalid_argument, which begins with `what`, for a session whose hand is simulated.
void require_prescribed(const SteppedSession& session, const char* what);

/// An input for each row: hands (N, 3), axes (N, 3) or (3,), pedals (N,) or one; nothing: the axis as it is,
/// the pedal up.
std::vector<HandInput> inputs_of(const SteppedSession& session, const Doubles& hands,
                                 const std::optional<Doubles>& axes, const std::optional<Flags>& pedals,
                                 std::int32_t burr);

Tick step(const SharedSession& session, const pybind11::object& hand_mm, const pybind11::object& axis,
          bool pedal, const pybind11::object& burr, std::int64_t ms);

pybind11::dict rollout(const SharedSession& session, const Doubles& hands, const std::optional<Doubles>& axes,
                       const std::optional<Flags>& pedals, const pybind11::object& burr);

pybind11::dict run(const SharedSession& session, std::int64_t ms);

// Motion of many sessions in one call, in threads of its own, without the interpreter's lock.

/// Moves each session along rows of its own, as rollout does, in up to `threads` threads; returns the last
/// tick of each. Each ends as it would alone, to the bit. All lists are of one length. Throws as rollout,
/// before any has moved, and for a session that is listed twice.
std::vector<Tick> step_together(const std::vector<SharedSession>& sessions, const std::vector<Doubles>& hands,
                                const std::vector<std::optional<Doubles>>& axes,
                                const std::vector<Flags>& pedals, int threads);

}  // namespace osteomill::python
