#include "python/module/tick_bindings.h"

#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "python/module/arrays.h"
#include "simulation/safety/fault.h"

namespace osteomill::python {

namespace {

py::dict by_name(const std::vector<std::string>& names, const std::vector<double>& values) {
    py::dict all;
    for (std::size_t i = 0; i < names.size(); ++i) all[py::str(names[i])] = values[i];
    return all;
}

py::dict removed(const Tick& tick) {
    py::dict all;
    all["total"] = tick.state.removed_in_all_mm3;
    all.attr("update")(by_name(tick.names->tissues, tick.state.removed_mm3));
    return all;
}

py::tuple row(const glm::dvec3& v) {
    return py::make_tuple(v.x, v.y, v.z);
}

glm::dvec3 vector_in(const py::handle& row) {
    const auto [x, y, z] = row.cast<std::tuple<double, double, double>>();
    return {x, y, z};
}

/// All values of a step, and nothing else: two steps of the same values are equal, and a step can be sent to
/// other processes.
py::tuple said(const Tick& tick) {
    const ToolState& tool = tick.state.tool;
    return py::make_tuple(
        tool.time_s, row(tool.hand_position_mm), row(tool.burr_position_mm), row(tool.spindle_axis),
        row(tool.force_n), row(tool.shank_torque_n_mm.value_or(glm::dvec3(0.0))),
        row(tick.state.milling_force_n), tool.depth_mm.value_or(0.0), tool.spindle_on, tool.burr,
        tool.peak_force_n.value_or(0.0), tool.touches_protected, std::string(tool.fault.text()),
        std::string(tool.notice.text()), tick.state.removed_in_all_mm3, tick.state.removed_mm3,
        tick.distance_mm, tick.names->tissues, tick.names->structures, tick.state.spindle_torque_n_mm,
        tick.state.spindle_power_w, row(tick.state.fixture_force_n));
}

Tick tick_that_said(const py::tuple& said) {
    if (said.size() != 22) throw std::invalid_argument("this is no Step of this version");
    Tick tick;
    tick.state.tool = {.time_s = said[0].cast<double>(),
                       .burr_position_mm = vector_in(said[2]),
                       .spindle_axis = vector_in(said[3]),
                       .hand_position_mm = vector_in(said[1]),
                       .force_n = vector_in(said[4]),
                       .burr = said[9].cast<std::size_t>(),
                       .spindle_on = said[8].cast<bool>(),
                       .touches_protected = said[11].cast<bool>(),
                       .fault = said[12].cast<std::string>(),
                       .notice = said[13].cast<std::string>(),
                       .depth_mm = said[7].cast<double>(),
                       .shank_torque_n_mm = vector_in(said[5]),
                       .peak_force_n = said[10].cast<double>()};
    tick.state.milling_force_n = vector_in(said[6]);
    tick.state.removed_in_all_mm3 = said[14].cast<double>();
    tick.state.spindle_torque_n_mm = said[19].cast<double>();
    tick.state.spindle_power_w = said[20].cast<double>();
    tick.state.fixture_force_n = vector_in(said[21]);
    tick.state.removed_mm3 = said[15].cast<std::vector<double>>();
    tick.distance_mm = said[16].cast<std::vector<double>>();
    tick.names = std::make_shared<const StepNames>(
        StepNames{said[17].cast<std::vector<std::string>>(), said[18].cast<std::vector<std::string>>()});
    if (tick.state.removed_mm3.size() != tick.names->tissues.size() ||
        tick.distance_mm.size() != tick.names->structures.size())
        throw std::invalid_argument("this is no Step of this version");
    return tick;
}

}  // namespace

Tick::Tick(TickState known, const LoadedCase& loaded) : state(std::move(known)), names(loaded.step_names()) {
    for (std::size_t i = 0; i < names->structures.size(); ++i)
        distance_mm.push_back(loaded.distance_mm(i, state.tool));
}

void bind_tick(py::module_& module) {
    py::list faults;
    faults.append("");
    for (const Fault fault : all_faults) faults.append(describe(fault));
    module.attr("FAULTS") = py::tuple(faults);

    const auto vector = [](auto read) {
        return [read](const Tick& tick) { return array_of(read(tick.state)); };
    };
    py::class_<Tick>(
        module, "Step",
        "The state after the last tick of a step. Vectors are (3,), in patient LPS; each is a copy.")
        .def_property_readonly(
            "time_s", [](const Tick& tick) { return tick.state.tool.time_s; }, "Session time of the tick.")
        .def_property_readonly("hand_mm", vector([](const TickState& s) { return s.tool.hand_position_mm; }),
                               "Where the hand is: (3,), mm. It leads the burr by what the coupling yields.")
        .def_property_readonly("burr_mm", vector([](const TickState& s) { return s.tool.burr_position_mm; }),
                               "Centre of the burr: (3,), mm.")
        .def_property_readonly("axis", vector([](const TickState& s) { return s.tool.spindle_axis; }),
                               "Direction of the spindle from tip to shank: (3,), unit.")
        .def_property_readonly("force_n", vector([](const TickState& s) { return s.tool.force_n; }),
                               "Force on the hand as the device gets it, within the arm's limit: (3,), N.")
        .def_property_readonly("torque_nmm", vector([](const TickState& s) {
                                   return s.tool.shank_torque_n_mm.value_or(glm::dvec3(0.0));
                               }),
                               "Moment of what bone does to the shank, about the burr's centre: (3,), N mm; "
                               "0 where no burr has a shank.")
        .def_property_readonly(
            "milling_force_n", vector([](const TickState& s) { return s.milling_force_n; }),
            "Force of the bone on the burr, mean over the newest milling step that the tick "
            "knew, limited by nothing: (3,), N.")
        .def_property_readonly("fixture_force_n",
                               vector([](const TickState& s) { return s.fixture_force_n; }),
                               "Force of the scene's fixtures on the burr, which the hand feels through the "
                               "coupling: (3,), N; 0 without any.")
        .def_property_readonly(
            "depth_mm", [](const Tick& tick) { return tick.state.tool.depth_mm.value_or(0.0); },
            "Depth of the burr below the place where it first met bone, along the spindle axis of that "
            "moment; 0 before.")
        .def_property_readonly(
            "removed_mm3", &removed,
            "Bone removed since the session began, mm^3, by tissue's name and in \"total\".")
        .def_property_readonly(
            "distance_mm", [](const Tick& tick) { return by_name(tick.names->structures, tick.distance_mm); },
            "From the burr's head to each protected structure, mm; 0 and below: they "
            "overlap, so deep; inf: farther "
            "than 3 mm, or twice the distance of its warning.")
        .def_property_readonly("spindle_on", [](const Tick& tick) { return tick.state.tool.spindle_on; })
        .def_property_readonly(
            "spindle_torque_nmm", [](const Tick& tick) { return tick.state.spindle_torque_n_mm; },
            "Torque that the cut of the tick's millisecond takes from the spindle, from the bone about the "
            "burr: N mm; "
            "0 while it stands, and of force models that do not cut.")
        .def_property_readonly(
            "spindle_power_w", [](const Tick& tick) { return tick.state.spindle_power_w; },
            "Power of that torque at the burr's speed, W.")
        .def_property_readonly(
            "burr", [](const Tick& tick) { return tick.state.tool.burr; }, "Number in Case.burrs.")
        .def_property_readonly(
            "peak_force_n", [](const Tick& tick) { return tick.state.tool.peak_force_n.value_or(0.0); },
            "Largest force on the hand since the session began, N.")
        .def_property_readonly(
            "touches_protected", [](const Tick& tick) { return tick.state.tool.touches_protected; },
            "A protected tissue was cut within the last 0.2 s.")
        .def_property_readonly(
            "fault", [](const Tick& tick) { return std::string(tick.state.tool.fault.text()); },
            "Why the force is off and the tool out of the bone; empty while all is well.")
        .def_property_readonly(
            "notice", [](const Tick& tick) { return std::string(tick.state.tool.notice.text()); },
            "The reason for which a request waits, such as a pedal that was held too long; empty: "
            "nothing.")
        .def("__eq__", [](const Tick& tick, const Tick& other) { return said(tick).equal(said(other)); })
        .def("__eq__", [](const Tick&, const py::object&) { return false; })
        .def(py::pickle(&said, &tick_that_said))
        .def("__repr__", [](const Tick& tick) {
            const glm::dvec3& force_n = tick.state.tool.force_n;
            return fmt::format("<Step at {:.3f} s: force ({:.3f}, {:.3f}, {:.3f}) N, {:.3f} mm^3 removed>",
                               tick.state.tool.time_s, force_n.x, force_n.y, force_n.z,
                               tick.state.removed_in_all_mm3);
        });
}

py::dict dict_of(TickColumns&& columns, const LoadedCase& loaded) {
    const auto n = static_cast<py::ssize_t>(columns.time_s.size());
    py::dict all;
    all["time_s"] = array_of(std::move(columns.time_s), {n});
    const auto vectors = [&](const char* name, std::vector<double>& column) {
        all[name] = array_of(std::move(column), {n, 3});
    };
    vectors("hand_mm", columns.hand_mm);
    vectors("burr_mm", columns.burr_mm);
    vectors("axis", columns.axis);
    vectors("force_n", columns.force_n);
    vectors("torque_nmm", columns.torque_nmm);
    vectors("milling_force_n", columns.milling_force_n);
    all["depth_mm"] = array_of(std::move(columns.depth_mm), {n});
    all["spindle_torque_nmm"] = array_of(std::move(columns.spindle_torque_nmm), {n});
    all["spindle_on"] = array_of(std::move(columns.spindle_on), {n}).attr("view")("bool");
    all["fault"] = array_of(std::move(columns.fault), {n});
    py::dict removed;
    removed["total"] = array_of(std::move(columns.removed_in_all_mm3), {n});
    for (std::size_t i = 0; i < columns.removed_mm3.size(); ++i)
        removed[py::str(loaded.labels()[i].name)] = array_of(std::move(columns.removed_mm3[i]), {n});
    all["removed_mm3"] = removed;
    py::dict distance;
    for (std::size_t i = 0; i < columns.distance_mm.size(); ++i)
        distance[py::str(loaded.structures()[i])] = array_of(std::move(columns.distance_mm[i]), {n});
    all["distance_mm"] = distance;
    return all;
}

}  // namespace osteomill::python
