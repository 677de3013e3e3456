// Sessions in Python: step, rollout, run, and going back to a state.
#include <fmt/format.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <functional>
#include <memory>
#include <mutex>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "common/bone/patient_space.h"
#include "common/scene/session_control.h"
#include "common/text/plain_text.h"
#include "python/module/arrays.h"
#include "python/module/bindings.h"
#include "python/module/bone_view.h"
#include "python/module/released_lock.h"
#include "python/module/tick_bindings.h"
#include "python/module/tick_columns.h"

namespace osteomill::python {

namespace {

using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Flags = py::array_t<bool, py::array::c_style | py::array::forcecast>;
using SharedSession = std::shared_ptr<SteppedSession>;

glm::dvec3 place_of(const py::handle& value, const char* argument) {
    const glm::dvec3 place_mm = vector_of(value, argument);
    if (!is_place(place_mm))
        throw std::invalid_argument(
            fmt::format("{}: lies more than {} mm from the origin", argument, farthest_place_mm));
    return place_mm;
}

std::optional<Grip> grip_of(const std::string& hand) {
    if (hand == "prescribed") return std::nullopt;
    if (hand == "light") return Grip::light;
    if (hand == "firm") return Grip::firm;
    throw std::invalid_argument(
        fmt::format("hand: \"{}\" is none; choose \"prescribed\", \"light\" or \"firm\"", hand));
}

/// The interpreter ends without the sessions that a daemon thread still refers to: their recordings would
/// stay unfinished. One that a thread is at work on, or of another process, is left as it is.
void end_at_exit(const SharedSession& session) {
    const auto end = [weak = std::weak_ptr(session)] {
        ends_interpreter.store(
            std::this_thread::get_id());  // from now on no other thread comes back for the lock
        const ReleasedLock released;
        const SharedSession left = weak.lock();
        if (!left || !left->is_of_this_process()) return;
        const std::unique_lock<std::mutex> held(left->busy(), std::try_to_lock);
        if (held) left->end();
    };
    py::module_::import("atexit").attr("register")(py::cpp_function(end));
}

SharedSession make_session(const std::shared_ptr<LoadedCase>& loaded, const std::string& hand,
                           const std::optional<std::string>& coupling,
                           const std::optional<std::string>& force_model,
                           const std::optional<double>& milling_rate_hz, bool vibration,
                           const py::object& start_mm, const py::object& start_axis,
                           const std::optional<std::filesystem::path>& record) {
    if (record && record->empty()) throw std::invalid_argument("record: is empty; give a file, or None");
    if (record && record->extension() != ".pcap")
        throw std::invalid_argument(
            fmt::format("record: takes the name of a pcap file, such as \"session.pcap\", not \"{}\"; "
                        "Recording.to_hdf5 makes HDF5 of it",
                        one_line(record->string())));
    SteppedOptions options{.grip = grip_of(hand),
                           .coupling = coupling.value_or(""),
                           .milling_rate_hz = milling_rate_hz,
                           .vibration = vibration,
                           .record = record};
    if (force_model) options.force_model = *force_model;
    if (!start_mm.is_none() || !start_axis.is_none()) {
        options.start = loaded->settings().start_pose;
        if (!start_mm.is_none()) options.start->position_mm = place_of(start_mm, "start_mm");
        if (!start_axis.is_none())
            options.start->spindle_axis = unit(vector_of(start_axis, "start_axis"), "start_axis");
    }
    // A forked process has the session's memory and none of its threads: there it is let go as it is.
    const auto let_go = [](SteppedSession* session) {
        if (session->is_of_this_process()) delete session;
    };
    const SharedSession session = [&] {
        const ReleasedLock released;
        return SharedSession(new SteppedSession(loaded, std::move(options)), let_go);
    }();
    if (record) end_at_exit(session);
    return session;
}

constexpr std::uint64_t ticks_between_signals = 1000;
constexpr auto most_ms = static_cast<std::int64_t>(1000.0 * longest_session_s);

/// Python's signals, Ctrl-C among them, wait for the interpreter's lock.
void raise_of_signal() {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

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

void require_prescribed(const SteppedSession& session, const char* what) {
    if (session.has_simulated_hand())
        throw std::invalid_argument(fmt::format(
            "{}: the simulated hand goes its own way; make the session with hand=\"prescribed\"", what));
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

/// Rows of three, N of them. Throws std::invalid_argument for another shape and for what is not finite.
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

py::bytes bytes_of(const FedMotion& motion) {
    std::string bytes(motion.inputs.size() * sizeof(HandInput), '\0');
    std::memcpy(bytes.data(), motion.inputs.data(), bytes.size());
    return bytes;
}

FedMotion motion_of(const std::string& session, const std::string& bytes) {
    if (bytes.size() % sizeof(HandInput) != 0)
        throw std::invalid_argument("the bytes are no state of a session");
    FedMotion motion{.session = session, .inputs = std::vector<HandInput>(bytes.size() / sizeof(HandInput))};
    std::memcpy(static_cast<void*>(motion.inputs.data()), bytes.data(), bytes.size());
    return motion;
}

std::uint64_t milliseconds_of(const FedMotion& motion) {
    return std::accumulate(motion.inputs.begin(), motion.inputs.end(), std::uint64_t{0},
                           [](std::uint64_t sum, const HandInput& one) { return sum + one.ticks; });
}

void bind_state(py::module_& module) {
    py::class_<FedMotion>(module, "State", R"(A state of a session, to go back to: the motion that led there.

A session is a pure function of its case, its settings and its hand, so its motion is its state. 80 bytes a millisecond that
differs from the one before; no bone. It can be pickled and sent to other processes.)")
        .def_property_readonly("ticks", &milliseconds_of,
                               "Milliseconds since the session began: load_state computes so many again.")
        .def("__repr__",
             [](const FedMotion& motion) {
                 return fmt::format("<State after {} ms>", milliseconds_of(motion));
             })
        .def(py::pickle(
            [](const FedMotion& motion) { return py::make_tuple(motion.session, bytes_of(motion)); },
            [](const py::tuple& kept) {
                return motion_of(kept[0].cast<std::string>(), kept[1].cast<std::string>());
            }));
}

std::string text_of(const SharedSession& session) {
    const std::unique_lock<std::mutex> held(session->busy(), std::try_to_lock);
    if (!held.owns_lock())
        return fmt::format("<Session of \"{}\", at work in another thread>", session->loaded().name());
    const ToolState& tool = session->tool();
    return fmt::format("<Session of \"{}\" at {:.3f} s: burr \"{}\", force {:.3f} N, {:.3f} mm^3 removed{}>",
                       session->loaded().name(), tool.time_s,
                       session->loaded().settings().burrs[tool.burr].name, glm::length(tool.force_n),
                       session->removed_in_all_mm3(), session->has_ended() ? ", closed" : "");
}

std::string html_of(const SharedSession& session) {
    const py::object escape = py::module_::import("html").attr("escape");
    const auto row = [&escape](const char* name, const std::string& value) {
        return fmt::format("<tr><th>{}</th><td>{}</td></tr>", name, escape(value).cast<std::string>());
    };
    const std::unique_lock<std::mutex> held = taken(session->busy());
    const ToolState& tool = session->tool();
    return "<table>" + row("case", session->loaded().name()) +
           row("time", fmt::format("{:.3f} s", tool.time_s)) +
           row("burr", session->loaded().settings().burrs[tool.burr].name) +
           row("force", fmt::format("{:.3f} N", glm::length(tool.force_n))) +
           row("removed", fmt::format("{:.3f} mm^3", session->removed_in_all_mm3())) +
           (tool.fault.text().empty() ? "" : row("fault", std::string(tool.fault.text()))) + "</table>";
}

}  // namespace

void bind_session(py::module_& module) {
    bind_tick(module);
    bind_state(module);
    py::class_<SteppedSession, SharedSession>(module, "Session",
                                              R"(A session on the virtual clock, stepped from outside.

A tick is a millisecond of session time, and takes what it takes to compute. Same case, same settings, same motion: the same
to the bit, and the same as `haptic_server --clock virtual`. The tick of time 0 is made with the session: the hand at its start,
the pedal up. Many sessions may be at work at once, each in a thread of its own: the interpreter's lock is released meanwhile.

The hand must move as a hand can: a jump of over 3 mm within a millisecond turns the force off (Step.fault), and the tool takes
hold again once it is clear of bone.)")
        .def(py::init(&make_session), py::arg("case").none(false), py::kw_only(),
             py::arg("hand") = "prescribed", py::arg("coupling") = py::none(),
             py::arg("force_model") = py::none(), py::arg("milling_rate_hz") = py::none(),
             py::arg("vibration") = false, py::arg("start_mm") = py::none(),
             py::arg("start_axis") = py::none(), py::arg("record") = py::none(),
             R"(Makes a session of a case.

hand: "prescribed" (its pose is what step and rollout say), or "light" or "firm": a simulated hand of that grip holds a simulated
arm and follows the case's trajectory. coupling, force_model, milling_rate_hz, vibration: as the options of haptic_server; None:
what is usual. start_mm (3,), start_axis (3,): where the tool starts, patient LPS, instead of the case's. record: a file (.pcap)
to record the session into; it is whole once the session is closed.
ValueError, RuntimeError: in one line, what is wrong and what would be right.)")
        .def("step", &step, py::kw_only(), py::arg("hand_mm") = py::none(), py::arg("axis") = py::none(),
             py::arg("pedal") = false, py::arg("burr") = py::none(), py::arg("ms") = 1,
             R"(Holds the hand at a pose for `ms` milliseconds; returns what the last of them knew, as a Step.

hand_mm (3,): patient LPS, mm. axis (3,): of the spindle, from tip to shank; of any length. Where None: as it was. pedal: down, so
that the spindle turns. burr: name or number of one to change to, away from bone with the spindle off.
A simulated hand takes ms alone. ValueError: an argument is wrong. RuntimeError: another thread steps the session, or it is closed.)")
        .def(
            "rollout", &rollout, py::arg("hands"), py::arg("axes") = py::none(),
            py::arg("pedals") = py::none(), py::kw_only(), py::arg("burr") = py::none(),
            R"(Moves the hand along a motion, a row a millisecond, without the interpreter's lock; returns what each tick knew.

hands (N, 3): patient LPS, mm. axes (N, 3), or (3,) for all; None: as it was. pedals (N,) of bool, or one for all; None: up.
Returns a dict of arrays: time_s, depth_mm (N,); hand_mm, burr_mm, axis, force_n, torque_nmm, milling_force_n (N, 3); spindle_on
(N,) of bool; fault (N,), numbers in osteomill.FAULTS, 0 while all is well; removed_mm3, a dict of (N,) by tissue and "total";
distance_mm, a dict of (N,) by protected structure. They are what Step has under these names. Errors as step.)")
        .def(
            "run", &run, py::arg("ms"),
            R"(Goes on for `ms` milliseconds, or until the simulated hand is at its trajectory's end; returns what rollout does.

A prescribed hand stays where it is, with the pedal up.)")
        .def_property_readonly(
            "now",
            [](const SharedSession& session) {
                const std::unique_lock<std::mutex> held = taken(session->busy());
                return Tick{session->state(), session->loaded()};
            },
            "What the last tick knew: a Step.")
        .def(
            "save_state",
            [](const SharedSession& session) {
                const std::unique_lock<std::mutex> held = taken(session->busy());
                return session->fed();
            },
            "The state, to go back to: a State. Costs a copy of the motion so far, and no bone.")
        .def(
            "load_state",
            [](const SharedSession& session, const FedMotion& motion) {
                const std::unique_lock<std::mutex> held = taken(session->busy());
                session->replay(motion, [](const std::function<void()>& compute) {
                    {
                        const ReleasedLock released;
                        compute();
                    }
                    raise_of_signal();
                });
            },
            py::arg("state"),
            "Goes (back) to a state, exactly: begins with the case's bone and computes State.ticks "
            "milliseconds again, which takes as "
            "long as they took. Ctrl-C leaves the session as it was. BadInput: the state is of another case "
            "or of "
            "other settings, or the session is recorded.")
        .def_property_readonly(
            "bone", [](const SharedSession& session) { return BoneView(session); },
            "The bone as it is whenever it is asked.")
        .def_property_readonly("case",
                               [](const SharedSession& session) {
                                   return std::const_pointer_cast<LoadedCase>(session->shared_case());
                               })
        .def_property_readonly("coupling",
                               [](const SharedSession& session) { return session->settings().coupling; })
        .def_property_readonly("force_model",
                               [](const SharedSession& session) { return session->settings().force_model; })
        .def_property_readonly(
            "milling_rate_hz",
            [](const SharedSession& session) { return session->settings().milling_rate_hz; })
        .def_property_readonly(
            "is_finished", [](const SharedSession& session) { return session->is_finished(); },
            "The simulated hand is at its trajectory's end.")
        .def(
            "close",
            [](const SharedSession& session) {
                const ReleasedLock released;
                const std::unique_lock<std::mutex> held = taken(session->busy());
                session->end();
            },
            "Ends the session; its recording is whole then. RuntimeError: that could not be written.")
        .def(
            "_show_into",
            [](const SharedSession& session, const std::filesystem::path& file) {
                const std::unique_lock<std::mutex> held = taken(session->busy());
                const ReleasedLock released;
                session->show_into(file);
            },
            py::arg("file"), "Writes what there is to see now as a recording of one state.")
        .def("__repr__", &text_of)
        .def("_repr_html_", &html_of)
        .def("__enter__", [](const SharedSession& session) { return session; })
        .def("__exit__", [](const py::object& session, const py::args&) { session.attr("close")(); });
}

}  // namespace osteomill::python
