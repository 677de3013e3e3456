#include "python/module/tick_bindings.h"

#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <string>
#include <utility>
#include <vector>

#include "python/module/arrays.h"
#include "simulation/safety/fault.h"

namespace osteomill::python {

namespace {

py::dict by_name(const Tick& tick) {
    py::dict removed;
    removed["total"] = tick.state.removed_in_all_mm3;
    for (std::size_t i = 0; i < tick.state.removed_mm3.size(); ++i)
        removed[py::str(tick.loaded->labels()[i].name)] = tick.state.removed_mm3[i];
    return removed;
}

py::dict distances(const Tick& tick) {
    py::dict distance;
    for (std::size_t i = 0; i < tick.loaded->structures().size(); ++i)
        distance[py::str(tick.loaded->structures()[i])] = tick.loaded->distance_mm(i, tick.state.tool);
    return distance;
}

}  // namespace

void bind_tick(py::module_& module) {
    py::list faults;
    faults.append("");
    for (const Fault fault : all_faults) faults.append(describe(fault));
    module.attr("FAULTS") = py::tuple(faults);

    const auto vector = [](auto read) {
        return [read](const Tick& tick) { return array_of(read(tick.state)); };
    };
    py::class_<Tick>(module, "Step",
                     "What the last tick of a step knew. Vectors are (3,), in patient LPS; each is a copy.")
        .def_property_readonly(
            "time_s", [](const Tick& tick) { return tick.state.tool.time_s; }, "Session time of the tick.")
        .def_property_readonly("hand_mm", vector([](const TickState& s) { return s.tool.hand_position_mm; }),
                               "Where the hand is: (3,), mm. It leads the burr by what the coupling yields.")
        .def_property_readonly("burr_mm", vector([](const TickState& s) { return s.tool.burr_position_mm; }),
                               "Centre of the burr: (3,), mm.")
        .def_property_readonly("axis", vector([](const TickState& s) { return s.tool.spindle_axis; }),
                               "Of the spindle, from tip to shank: (3,), unit.")
        .def_property_readonly("force_n", vector([](const TickState& s) { return s.tool.force_n; }),
                               "Force on the hand as the device gets it, within the arm's limit: (3,), N.")
        .def_property_readonly("torque_nmm", vector([](const TickState& s) {
                                   return s.tool.shank_torque_n_mm.value_or(glm::dvec3(0.0));
                               }),
                               "Moment of what bone does to the shank, about the burr's centre: (3,), N mm; "
                               "0 where no burr has a shank.")
        .def_property_readonly("milling_force_n",
                               vector([](const TickState& s) { return s.milling_force_n; }),
                               "Of the bone on the burr, mean over the newest milling step that the tick "
                               "knew, limited by nothing: (3,), N.")
        .def_property_readonly(
            "depth_mm", [](const Tick& tick) { return tick.state.tool.depth_mm.value_or(0.0); },
            "Of the burr below where it first met bone, along the spindle axis of that moment; 0 before.")
        .def_property_readonly(
            "removed_mm3", &by_name,
            "Bone removed since the session began, mm^3, by tissue's name and in \"total\".")
        .def_property_readonly("distance_mm", &distances,
                               "From the burr's head to each protected structure, mm; 0 and below: they "
                               "overlap, so deep; inf: farther "
                               "than 3 mm, or twice the distance of its warning.")
        .def_property_readonly("spindle_on", [](const Tick& tick) { return tick.state.tool.spindle_on; })
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
            "What something that was requested waits for, such as a pedal that was held too long; empty: "
            "nothing.")
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
