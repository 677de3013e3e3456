// Sessions in Python: made of a case, moved, copied, and taken back to a state.
#include <fmt/format.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cstring>
#include <functional>
#include <memory>
#include <mutex>
#include <numeric>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "common/text/foreign_text.h"
#include "python/module/arrays.h"
#include "python/module/bindings.h"
#include "python/module/python_bone.h"
#include "python/module/released_lock.h"
#include "python/module/session_motion.h"
#include "python/module/stepped_session.h"

namespace osteomill::python {

namespace {

std::optional<Grip> grip_of(const std::string& hand) {
    if (hand == "prescribed") return std::nullopt;
    if (hand == "light") return Grip::light;
    if (hand == "firm") return Grip::firm;
    throw std::invalid_argument(
        fmt::format("hand: \"{}\" is none; choose \"prescribed\", \"light\" or \"firm\"", hand));
}

/// The interpreter does not destroy sessions to which a daemon thread still refers; their recordings would
/// stay unfinished, so they are ended here. A session that a thread is working on, or of another process, is
/// left alone.
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

/// A forked process has the session's memory and none of its threads: there the session is leaked.
void let_go(SteppedSession* session) {
    if (session->is_of_this_process()) delete session;
}

SharedSession copy_of(const SharedSession& session) {
    const ReleasedLock released;
    const std::unique_lock<std::mutex> held = taken(session->busy());
    return SharedSession(new SteppedSession(*session), let_go);
}

SharedSession make_session(const std::shared_ptr<LoadedCase>& loaded, const std::string& hand,
                           const std::optional<std::string>& coupling,
                           const std::optional<std::string>& force_model,
                           const std::optional<double>& milling_rate_hz, bool vibration,
                           const py::object& start_mm, const py::object& start_axis,
                           const std::optional<ArmModel>& arm,
                           const std::optional<std::filesystem::path>& record) {
    if (record && record->empty()) throw std::invalid_argument("record: is empty; give a file, or None");
    if (record && record->extension() != ".pcap")
        throw std::invalid_argument(
            fmt::format("record: takes the name of a pcap file, such as \"session.pcap\", not \"{}\"; "
                        "Recording.to_hdf5 makes HDF5 of it",
                        one_line(record->string())));
    SteppedOptions options{.grip = grip_of(hand),
                           .milling_rate_hz = milling_rate_hz,
                           .vibration = vibration,
                           .arm = arm,
                           .record = record};
    if (coupling) options.coupling = coupling_named(*coupling);
    if (force_model) options.force_model = *force_model;
    if (!start_mm.is_none() || !start_axis.is_none()) {
        options.start = loaded->settings().start_pose;
        if (!start_mm.is_none()) options.start->position_mm = place_of(start_mm, "start_mm");
        if (!start_axis.is_none())
            options.start->spindle_axis = unit(vector_of(start_axis, "start_axis"), "start_axis");
    }
    const SharedSession session = [&] {
        const ReleasedLock released;
        return SharedSession(new SteppedSession(loaded, std::move(options)), let_go);
    }();
    if (record) end_at_exit(session);
    return session;
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
    module.def("_step_together", &step_together, py::arg("sessions"), py::arg("hands"), py::arg("axes"),
               py::arg("pedals"), py::arg("threads"), "Backs osteomill.VectorEnv.");
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
             py::arg("start_axis") = py::none(), py::arg("arm") = py::none(), py::arg("record") = py::none(),
             R"(Makes a session of a case.

hand: "prescribed" (its pose is what step and rollout say), or "light" or "firm": a simulated hand of that grip holds a simulated
arm and follows the case's trajectory. coupling, force_model, milling_rate_hz, vibration: as the options of haptic_server; None:
what is usual. start_mm (3,), start_axis (3,): where the tool starts, patient LPS, instead of the case's. arm: an Arm of
one's own; None: the usual one, of up to 3.3 N; at prescribed poses it has no encoder steps and bears a spring of 2.3 N/mm, not 1.5.
record: a file (.pcap) to record the session into; it is whole once the session is closed.
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
            "The state after the last tick: a Step.")
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
        .def("copy", &copy_of,
             R"(Another session that goes on from here: with the same motion the same to the bit.

It costs what was touched of the bone, and the motion so far, not the time that led here; neither disturbs the other, and each may
go to a thread of its own. A copy of a session that is recorded is not. Fault: the session is closed.)")
        .def("__copy__", &copy_of)
        .def(
            "__deepcopy__", [](const SharedSession& session, const py::dict&) { return copy_of(session); },
            py::arg("memo"))
        .def_property_readonly(
            "bone", [](const SharedSession& session) { return PythonBone(session); },
            "The bone as it is whenever it is asked.")
        .def_property_readonly("case",
                               [](const SharedSession& session) {
                                   return std::const_pointer_cast<LoadedCase>(session->shared_case());
                               })
        .def_property_readonly(
            "coupling", [](const SharedSession& session) { return name_of(session->settings().coupling); })
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
        .def("__repr__", &text_of)
        .def("_repr_html_", &html_of)
        .def("__enter__", [](const SharedSession& session) { return session; })
        .def("__exit__", [](const py::object& session, const py::args&) { session.attr("close")(); });
}

// A session's state in Python: the motion that led there.

namespace py = pybind11;

namespace {

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

}  // namespace

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

}  // namespace osteomill::python
