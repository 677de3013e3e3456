// Cases and burrs in Python.
#include <fmt/format.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/scene/scene_file.h"
#include "python/module/arrays.h"
#include "python/module/bindings.h"
#include "python/module/python_bone.h"
#include "python/module/released_lock.h"

namespace osteomill::python {

namespace {

/// Raises the error of a wrong argument, as Python words it.
[[noreturn]] void fail(const std::string& line) {
    constexpr std::string_view option = "--case: ";
    throw std::invalid_argument(line.starts_with(option) ? "name: " + line.substr(option.size()) : line);
}

std::optional<std::string> burr_named(const py::object& burr) {
    if (burr.is_none()) return std::nullopt;
    if (!py::isinstance<py::str>(burr))
        throw std::invalid_argument(
            fmt::format("burr: takes the name of one of the case's, such as \"2 mm\", not {}",
                        std::string(py::repr(burr))));
    return burr.cast<std::string>();
}

/// Changes of `choice`; the parts of `similar` that they leave unchanged are shared.
std::shared_ptr<LoadedCase> load_changed(const std::string& name, SceneChoice choice,
                                         const std::vector<std::string>& set,
                                         const std::optional<std::string>& burr,
                                         const std::optional<double>& rpm,
                                         const std::optional<std::filesystem::path>& bone,
                                         const std::optional<std::filesystem::path>& trajectory,
                                         const LoadedCase* similar) {
    choice.changes.option = "set";
    for (const std::string& change : set) choice.changes.changes.push_back(parse_scene_change(change));
    if (burr) choice.changes.changes.push_back({.key = "start_burr", .value = *burr, .is_text = true});
    if (rpm) choice.spindle_rpm = rpm;
    if (bone) choice.bone = bone;
    if (trajectory) choice.trajectory = trajectory;
    try {
        return std::make_shared<LoadedCase>(name, std::move(choice), similar);
    } catch (const SceneError& wrong) {
        // A key of `set` is an argument; a file is not.
        if (std::string_view(wrong.what()).starts_with("set: ")) fail(wrong.what());
        throw;
    } catch (const std::invalid_argument& wrong) {
        fail(wrong.what());
    }
}

std::shared_ptr<LoadedCase> load(const std::string& name, const std::vector<std::string>& set,
                                 const py::object& burr, const std::optional<double>& rpm,
                                 const std::optional<std::filesystem::path>& bone,
                                 const std::optional<std::filesystem::path>& trajectory) {
    const std::optional<std::string> start_burr = burr_named(burr);
    const ReleasedLock released;
    SceneChoice choice;
    try {
        choice = name.ends_with(".toml") ? SceneChoice{.name = name} : case_chosen(name);
    } catch (const std::invalid_argument& wrong) {
        fail(wrong.what());
    }
    return load_changed(name, std::move(choice), set, start_burr, rpm, bone, trajectory, nullptr);
}

std::shared_ptr<LoadedCase> with(const LoadedCase& loaded, const std::vector<std::string>& set,
                                 const py::object& burr, const std::optional<double>& rpm,
                                 const std::optional<std::filesystem::path>& bone,
                                 const std::optional<std::filesystem::path>& trajectory) {
    const std::optional<std::string> start_burr = burr_named(burr);
    const ReleasedLock released;
    return load_changed(loaded.name(), loaded.choice(), set, start_burr, rpm, bone, trajectory, &loaded);
}

/// Pickled form of a case: the choice that led to it, so that another process loads it again.
py::tuple kept(const LoadedCase& loaded) {
    const SceneChoice& choice = loaded.choice();
    py::list changes;
    for (const SceneChange& change : choice.changes.changes)
        changes.append(py::make_tuple(change.key, change.value, change.is_text));
    return py::make_tuple(loaded.name(), choice.name, changes, choice.spindle_rpm, choice.bone,
                          choice.trajectory, choice.case_folder);
}

std::shared_ptr<LoadedCase> load_kept(const py::tuple& kept) {
    SceneChoice choice{.name = kept[1].cast<std::optional<std::string>>(),
                       .spindle_rpm = kept[3].cast<std::optional<double>>(),
                       .bone = kept[4].cast<std::optional<std::filesystem::path>>(),
                       .trajectory = kept[5].cast<std::optional<std::filesystem::path>>(),
                       .case_folder = kept[6].cast<std::optional<std::filesystem::path>>()};
    choice.changes.option = "set";
    for (const py::handle& one : kept[2]) {
        const auto change = one.cast<py::tuple>();
        choice.changes.changes.push_back({.key = change[0].cast<std::string>(),
                                          .value = change[1].cast<std::string>(),
                                          .is_text = change[2].cast<bool>()});
    }
    const auto name = kept[0].cast<std::string>();
    const ReleasedLock released;
    return std::make_shared<LoadedCase>(name, std::move(choice));
}

Burr make_burr(double diameter_mm, int edges, double rpm, const py::handle& cutting, const py::handle& edge,
               bool clockwise) {
    // Limits as in a scene, except for diameters in studies.
    if (!(diameter_mm > 0.0 && diameter_mm <= 100.0) || edges < 1 || edges > 64 || !(rpm > 0.0 && rpm <= 1e6))
        throw std::invalid_argument(fmt::format(
            "a burr has a diameter_mm above 0, up to 100, 1 to 64 edges and rpm above 0, up to 1e6, not "
            "{} mm, {} and {} rpm",
            diameter_mm, edges, rpm));
    return {.name = fmt::format("{:g} mm", diameter_mm),
            .diameter_mm = diameter_mm,
            .edges = edges,
            .spindle_rev_per_s = rpm / 60.0,
            .cutting_coefficients_n_per_mm2 = vector_of(cutting, "cutting_coefficients_n_per_mm2"),
            .edge_coefficients_n_per_mm = vector_of(edge, "edge_coefficients_n_per_mm"),
            .sense = clockwise ? SpindleSense::clockwise : SpindleSense::counter_clockwise};
}

void bind_burr(py::module_& module) {
    py::class_<Burr>(module, "Burr",
                     "A burr: its head and its cutting coefficients. Those of a case are in Case.burrs.")
        .def(py::init(&make_burr), py::kw_only(), py::arg("diameter_mm"), py::arg("edges") = 6,
             py::arg("rpm") = default_spindle_rpm,
             py::arg("cutting_coefficients_n_per_mm2") = py::make_tuple(230.0, 40.0, 20.0),
             py::arg("edge_coefficients_n_per_mm") = py::make_tuple(0.0, 0.0, 0.0),
             py::arg("clockwise") = true,
             "A ball. The coefficients are K_t, K_r, K_a (N/mm^2) and K_te, K_re, K_ae (N/mm) of bone of "
             "relative stiffness 1; "
             "`clockwise` is seen from the handpiece.")
        .def_property_readonly("name", [](const Burr& burr) { return burr.name; })
        .def_property_readonly(
            "diameter_mm", [](const Burr& burr) { return burr.diameter_mm; }, "The largest of the head.")
        .def_property_readonly("edges", [](const Burr& burr) { return burr.edges; })
        .def_property_readonly(
            "rpm", [](const Burr& burr) { return 60.0 * burr.spindle_rev_per_s; },
            "Speed of the spindle, rev/min.")
        .def_property_readonly(
            "cutting_coefficients_n_per_mm2",
            [](const Burr& burr) { return array_of(burr.cutting_coefficients_n_per_mm2); },
            "K_t, K_r, K_a for bone of relative stiffness 1: (3,).")
        .def_property_readonly(
            "edge_coefficients_n_per_mm",
            [](const Burr& burr) { return array_of(burr.edge_coefficients_n_per_mm); },
            "K_te, K_re, K_ae: force of each mm of edge that cuts: (3,).")
        .def("__repr__", [](const Burr& burr) {
            return fmt::format("<Burr \"{}\": {:g} mm, {} edges, {:g} rpm>", burr.name, burr.diameter_mm,
                               burr.edges, 60.0 * burr.spindle_rev_per_s);
        });
}

}  // namespace

void bind_case(py::module_& module) {
    bind_burr(module);
    py::class_<LoadedCase, std::shared_ptr<LoadedCase>>(
        module, "Case",
        R"(The start of a session: the bone, its tissues, the burrs, and where the tool starts.

It is loaded once and never changes; any number of sessions, in any number of threads, are made of one. Positions are in
patient LPS, mm.)")
        .def(py::init(&load), py::arg("name"), py::kw_only(), py::arg("set") = std::vector<std::string>(),
             py::arg("burr") = py::none(), py::arg("rpm") = py::none(), py::arg("bone") = py::none(),
             py::arg("trajectory") = py::none(),
             R"(Loads a case.

name: a folder that bone_import --case made, one built in ("tooth", "cube", "head"), or a scene's TOML file.
set: changes of the scene's keys, as haptic_server --set takes them: ["wall_friction=0.3"].
burr: the one to start with, by its name in the scene. rpm: of every burr. bone: a file that bone_import wrote, instead of the
case's. trajectory: a CSV file that the simulated hand follows, instead of the case's.
It can be pickled: the other process loads it from the same files once more.
BadInput, Fault: in one line, what is wrong and what would be right.)")
        .def("with_", &with, py::kw_only(), py::arg("set") = std::vector<std::string>(),
             py::arg("burr") = py::none(), py::arg("rpm") = py::none(), py::arg("bone") = py::none(),
             py::arg("trajectory") = py::none(),
             R"(The same case with other settings, each as for Case; those that were given before stay.

The bone is shared where they leave it as it is, so that this takes milliseconds: burrs, friction, where the tool starts. A
tissue's stiffness or another bone loads it anew. Errors as Case.)")
        .def(py::pickle(&kept, &load_kept))
        .def_property_readonly("name", &LoadedCase::name)
        .def_property_readonly(
            "bone",
            [](const std::shared_ptr<LoadedCase>& loaded) {
                return PythonBone(std::shared_ptr<const LoadedCase>(loaded));
            },
            "The bone before anything is milled.")
        .def_property_readonly(
            "tissues",
            [](const LoadedCase& loaded) {
                py::dict labels;
                for (const Tissue& tissue : loaded.settings().tissues)
                    labels[py::str(tissue.name)] = tissue.label;
                return labels;
            },
            "The label of each tissue, by name.")
        .def_property_readonly(
            "removal_names",
            [](const LoadedCase& loaded) {
                std::vector<std::string> names{"total"};
                for (const LoadedCase::NamedLabel& one : loaded.labels()) names.push_back(one.name);
                return names;
            },
            "Keys of removed_mm3, in order.")
        .def_property_readonly(
            "structures", [](const LoadedCase& loaded) { return loaded.structures(); },
            "Names of the protected tissues, whose distance is measured.")
        .def(
            "plan_distance_mm",
            [](const LoadedCase& loaded, const py::object& place_mm) -> std::optional<double> {
                if (!loaded.has_plan()) return std::nullopt;
                const glm::dvec3 place = vector_of(place_mm, "place_mm");
                const ReleasedLock released;
                return loaded.plan_distance_mm(place);
            },
            py::arg("place_mm"),
            "From a place (3,), patient LPS, to what shall be removed as the case's plan says, mm; below 0: "
            "within, so "
            "deep; None: the case has no plan. For a tissue the distance is to the centre of its nearest "
            "voxel.")
        .def_property_readonly(
            "burrs", [](const LoadedCase& loaded) { return loaded.settings().burrs; },
            "The set that a session may take from.")
        .def_property_readonly(
            "start_burr", [](const LoadedCase& loaded) { return loaded.settings().start_burr; },
            "Number of the burr that a session starts with.")
        .def_property_readonly(
            "start_mm",
            [](const LoadedCase& loaded) { return array_of(loaded.settings().start_pose.position_mm); },
            "Where the burr's centre starts, patient LPS: (3,).")
        .def_property_readonly(
            "start_axis",
            [](const LoadedCase& loaded) { return array_of(loaded.settings().start_pose.spindle_axis); },
            "How the spindle points at the start, from tip to shank: (3,), unit.")
        .def("__repr__",
             [](const LoadedCase& loaded) { return fmt::format("<Case \"{}\">", loaded.name()); });
}

}  // namespace osteomill::python
