// Milling models on paths through blocks of bone, and the analytical reference of steady motions. A model
// computes without Python's lock.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <array>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "imaging/case/bone_source.h"
#include "imaging/phantoms/phantom.h"
#include "python/module/arrays.h"
#include "python/studies_module/bindings.h"
#include "studies/force/bone_block.h"
#include "studies/force/contact_curves.h"
#include "studies/force/path_run.h"
#include "studies/force/random_motions.h"
#include "studies/force/steady_run.h"

namespace osteomill::python {

namespace {

using study::BoneBlock;
using study::ForceSeries;
using study::RandomMotion;
using study::SteadyCase;
using study::SteadyRun;
using Vector = std::array<double, 3>;

glm::dvec3 vector_of(const Vector& v) {
    return {v[0], v[1], v[2]};
}

template <typename Value>
Value chosen(const std::map<std::string, Value>& values, const std::string& name, const char* what) {
    if (const auto found = values.find(name); found != values.end()) return found->second;
    std::string known;
    for (const auto& [one, value] : values) known += (known.empty() ? "" : ", ") + one;
    throw std::invalid_argument(std::string(what) + ": '" + name + "' is not one of " + known);
}

/// A way to mill.
struct StudiedMilling {
    MillingSettings settings{};
    bool has_map = false;

    study::MakeModel make() const {
        return has_map ? study::voxel_model_with_engagement() : study::voxel_model(settings);
    }
};

StudiedMilling milling(const std::string& summation, const std::string& coverage, const std::string& search,
                       const std::pair<int, int>& bins, int instants, bool has_map) {
    StudiedMilling made{.has_map = has_map};
    made.settings.summation = chosen<ForceSummation>({{"voxels", ForceSummation::voxels},
                                                      {"bins", ForceSummation::bins},
                                                      {"instants", ForceSummation::instants}},
                                                     summation, "summation");
    made.settings.coverage = chosen<VoxelCoverage>({{"smoothed", VoxelCoverage::smoothed},
                                                    {"linear", VoxelCoverage::linear},
                                                    {"binary", VoxelCoverage::binary}},
                                                   coverage, "coverage");
    made.settings.search = chosen<VoxelSearch>(
        {{"crescent", VoxelSearch::crescent}, {"full_scan", VoxelSearch::full_scan}}, search, "search");
    made.settings.bins = {bins.first, bins.second};
    made.settings.instants_per_tooth = instants;
    return made;
}

/// step_s, force_n (n, 3), removed_mm3 (n,), step_us (n,)
py::tuple tuple_of(const ForceSeries& series) {
    const auto count = static_cast<py::ssize_t>(series.force_n.size());
    py::array_t<double> force_n({count, py::ssize_t{3}});
    for (py::ssize_t i = 0; i < count; ++i)
        for (int axis = 0; axis < 3; ++axis)
            *force_n.mutable_data(i, axis) = series.force_n[static_cast<std::size_t>(i)][axis];
    return py::make_tuple(series.step_s, force_n, py::array_t<double>(count, series.removed_mm3.data()),
                          py::array_t<double>(count, series.step_us.data()));
}

py::list run_path(const std::vector<StudiedMilling>& models, const Bone& bone, const Burr& burr,
                  const Vector& axis, double step_s, const std::vector<Vector>& positions_mm) {
    std::vector<glm::dvec3> positions;
    for (const Vector& position : positions_mm) positions.push_back(vector_of(position));
    std::vector<ForceSeries> runs;
    {
        const py::gil_scoped_release released;
        std::vector<std::unique_ptr<study::StudiedModel>> made;
        for (const StudiedMilling& model : models) made.push_back(model.make()(bone, burr));
        runs = study::run_in_turns(made, vector_of(axis), step_s, positions);
    }
    py::list all;
    for (const ForceSeries& series : runs) all.append(tuple_of(series));
    return all;
}

py::tuple run_steady(const SteadyCase& c, const StudiedMilling& model, const SteadyRun& run) {
    ForceSeries series;
    {
        const py::gil_scoped_release released;
        series = study::run_steady(c, run, model.make());
    }
    return tuple_of(series);
}

py::tuple steady_reference(const SteadyCase& c) {
    const py::gil_scoped_release released;
    const study::SteadyMotion motion = motion_of(c);
    const study::BoneFunction bone = bone_of(c);
    const glm::dvec3 force_n = study::mean_reference_force_n(motion, bone);
    const double removal = study::reference_removal_mm3_per_s(motion, bone);
    const py::gil_scoped_acquire acquired;
    return py::make_tuple(array_of(force_n), removal);
}

/// Reference force in the flat bone {z <= 0}, whose top layer has another stiffness.
py::array_t<double> reference_force(const Burr& burr, const Vector& position_mm, const Vector& axis,
                                    const Vector& velocity_mm_per_s,
                                    const std::optional<std::pair<double, double>>& layer) {
    glm::dvec3 force_n(0.0);
    {
        const py::gil_scoped_release released;
        const auto [thickness_mm, stiffness] = layer.value_or(std::pair(0.0, 1.0));
        force_n = study::mean_reference_force_n({.burr = burr,
                                                 .position_mm = vector_of(position_mm),
                                                 .spindle_axis = vector_of(axis),
                                                 .velocity_mm_per_s = vector_of(velocity_mm_per_s)},
                                                [thickness_mm, stiffness](const glm::dvec3& p) {
                                                    if (p.z > 0.0) return 0.0;
                                                    return -p.z < thickness_mm ? stiffness : 1.0;
                                                });
    }
    return array_of(force_n);
}

Bone block(const Vector& low_mm, const Vector& high_mm, double voxel_mm,
           const std::optional<std::pair<double, double>>& layer) {
    const py::gil_scoped_release released;
    BoneBlock made{.low_mm = vector_of(low_mm), .high_mm = vector_of(high_mm)};
    if (layer) made.layer = study::TopLayer{layer->first, layer->second};
    return study::voxelised(made, voxel_mm);
}

Bone scene_bone(const std::string& name) {
    return load_bone(phantom_scene(name)).bone;
}

/// A motion of 1 mm depth at 6 mm/s and 10 000 rpm, unless given otherwise.
SteadyCase steady_case(const std::string& name, const Burr& burr, double feed_mm_per_s, double depth_mm) {
    return {.name = name, .burr = burr, .velocity_mm_per_s = {feed_mm_per_s, 0.0, 0.0}, .depth_mm = depth_mm};
}

std::vector<RandomMotion> random_motions(int count, std::uint64_t seed, double voxel_mm,
                                         std::optional<double> depth_mm, bool edge_forces, bool heads,
                                         double travel_mm, double least_dive_voxels, bool is_milled) {
    auto motions = study::random_motions(count, seed, voxel_mm);
    for (RandomMotion& drawn : motions) {
        drawn.run.travel_mm = travel_mm;
        drawn.run.least_dive_voxels = least_dive_voxels;
        drawn.run.is_milled = is_milled;
    }
    if (depth_mm) study::set_depth(motions, *depth_mm);
    if (edge_forces) study::draw_edge_forces(motions, seed);
    if (heads) study::draw_heads(motions, seed);
    return motions;
}

void bind_models(py::module_& module) {
    py::class_<StudiedMilling>(module, "Milling", "A way to mill.")
        .def(py::init(&milling), py::kw_only(), py::arg("summation") = "voxels",
             py::arg("coverage") = "smoothed", py::arg("search") = "crescent",
             py::arg("bins") = std::pair(72, 50), py::arg("instants") = 20, py::arg("map") = false,
             "map: the default one, with the engagement map that the implicit coupling solves against.");
    py::class_<Bone>(module, "Block", "Bone in voxels.")
        .def(py::init(&block), py::arg("low_mm"), py::arg("high_mm"), py::arg("voxel_mm"),
             py::arg("layer") = py::none(),
             "Flat bone {z <= 0} within a box; its top layer may be (thickness in mm, relative stiffness).")
        .def_static("cube", &study::cube_of_bone, py::arg("edge_voxels"), py::arg("voxel_mm"),
                    py::arg("box_voxels") = 0, py::call_guard<py::gil_scoped_release>(),
                    "Solid, its top face at z = 0, in a box of that edge; edges are multiples of 16.")
        .def_static("scene", &scene_bone, py::arg("name"), py::call_guard<py::gil_scoped_release>(),
                    "The bone of a built-in scene.")
        .def_property_readonly("box_mm3",
                               [](const Bone& bone) {
                                   const glm::dvec3 edges_mm =
                                       glm::dvec3(bone.grid().size_voxels) * bone.grid().spacing_mm;
                                   return edges_mm.x * edges_mm.y * edges_mm.z;
                               })
        .def_property_readonly("memory_bytes", [](const Bone& bone) { return memory_bytes(bone); })
        .def_property_readonly("bone_mm3", [](const Bone& bone) { return bone_volume_mm3(bone); });
    module.def(
        "run_path", &run_path, py::arg("models"), py::arg("block"), py::arg("burr"), py::arg("axis"),
        py::arg("step_s"), py::arg("positions_mm"),
        "Moves a burr through a copy of the bone for each model, from position to position in steps of "
        "step_s; in turns, step by step, so that their times can be compared. Of each: step_s, force_n "
        "(n, 3), removed_mm3 (n,), step_us (n,).");
    module.def("reference_force", &reference_force, py::arg("burr"), py::arg("position_mm"), py::arg("axis"),
               py::arg("velocity_mm_per_s"), py::arg("layer") = py::none(),
               "Analytical mean force in flat bone {z <= 0}, N: (3,).");
}

void bind_steady(py::module_& module) {
    const auto run_of = [](double voxel_mm, double rate_hz, double travel_mm, int min_steps) {
        return SteadyRun{
            .voxel_mm = voxel_mm, .milling_rate_hz = rate_hz, .travel_mm = travel_mm, .min_steps = min_steps};
    };
    py::class_<SteadyCase>(module, "SteadyCase", "A burr in steady motion over a half space of bone.")
        .def(py::init(&steady_case), py::arg("name"), py::arg("burr"), py::arg("feed_mm_per_s"),
             py::arg("depth_mm"), "Upright, along x, in the flat bone {z <= 0}.")
        .def_readonly("name", &SteadyCase::name)
        .def_readonly("burr", &SteadyCase::burr)
        .def_readonly("depth_mm", &SteadyCase::depth_mm)
        .def_readonly("groove_mm_higher", &SteadyCase::previous_groove_mm_higher)
        .def_property_readonly("clockwise",
                               [](const SteadyCase& c) { return c.burr.sense == SpindleSense::clockwise; })
        .def_property_readonly("feed_mm_per_s",
                               [](const SteadyCase& c) { return glm::length(c.velocity_mm_per_s); })
        .def_property_readonly(
            "mean_force_n", [](const SteadyCase& c) { return array_of(c.mean_force_n); },
            "As the file states it.")
        .def_readonly("removal_mm3_per_s", &SteadyCase::removal_mm3_per_s, "As the file states it.")
        .def(
            "with_edges",
            [](SteadyCase c, const Vector& edges) {
                c.burr.edge_coefficients_n_per_mm = vector_of(edges);
                return c;
            },
            py::arg("edge_coefficients_n_per_mm"), "The same with a burr whose edges rub.")
        .def("reference", &steady_reference,
             "By the analytical reference: the mean force (3,), N, and what is removed, mm^3/s.")
        .def(
            "path",
            [run_of](const SteadyCase& c, double voxel_mm, double rate_hz, double travel_mm, int min_steps) {
                const study::SteadyPath path = path_of(c, run_of(voxel_mm, rate_hz, travel_mm, min_steps));
                return std::pair(path.steps, glm::length(path.end_mm - path.start_mm));
            },
            py::arg("voxel_mm") = 0.1, py::arg("milling_rate_hz") = 100.0, py::arg("travel_mm") = 2.0,
            py::arg("min_steps") = 20, "Steps, and how far they go, mm.")
        .def(
            "run",
            [run_of](const SteadyCase& c, const StudiedMilling& model, double voxel_mm, double rate_hz,
                     double travel_mm, int min_steps) {
                return run_steady(c, model, run_of(voxel_mm, rate_hz, travel_mm, min_steps));
            },
            py::arg("model"), py::arg("voxel_mm") = 0.1, py::arg("milling_rate_hz") = 100.0,
            py::arg("travel_mm") = 2.0, py::arg("min_steps") = 20, "As run_path.");
    module.def("steady_cases", &study::read_steady_cases, py::arg("file"),
               "Those of a JSON file in the schema of tests/data/milling_forces.json.");
    py::class_<RandomMotion>(module, "RandomMotion", "A steady motion drawn at random.")
        .def_readonly("motion", &RandomMotion::motion)
        .def_readonly("tilt_deg", &RandomMotion::tilt_deg)
        .def_readonly("azimuth_deg", &RandomMotion::azimuth_deg)
        .def_readonly("dives", &RandomMotion::dives)
        .def_property_readonly("voxel_mm", [](const RandomMotion& drawn) { return drawn.run.voxel_mm; })
        .def_property_readonly("milling_rate_hz",
                               [](const RandomMotion& drawn) { return drawn.run.milling_rate_hz; })
        .def(
            "reference",
            [](const RandomMotion& drawn) {
                glm::dvec3 force_n(0.0);
                {
                    const py::gil_scoped_release released;
                    force_n = study::reference_over_path_n(drawn);
                }
                return array_of(force_n);
            },
            "Analytical mean force, of a dive over its path, N: (3,).")
        .def("reference_parts", &study::reference_parts_over_path_n, py::call_guard<py::gil_scoped_release>(),
             "Sum of the magnitudes of that force's parts, N.")
        .def(
            "run",
            [](const RandomMotion& drawn, const StudiedMilling& model, double surface_voxels) {
                SteadyRun run = drawn.run;
                run.surface_voxels = surface_voxels;
                return run_steady(drawn.motion, model, run);
            },
            py::arg("model"), py::arg("surface_voxels") = 0.0,
            "As run_path; the bone's surface, and the burr with it, so far outward of its place in the "
            "lattice.");
    module.def("random_motions", &random_motions, py::arg("count"), py::arg("seed"),
               py::arg("voxel_mm") = 0.1, py::arg("depth_mm") = py::none(), py::arg("edge_forces") = false,
               py::arg("heads") = false, py::arg("travel_mm") = 2.0, py::arg("least_dive_voxels") = 0.0,
               py::arg("is_milled") = false,
               "The same for the same seed on every machine. How they run: as SteadyRun has it.");
}

}  // namespace

void bind_forces(py::module_& module) {
    bind_models(module);
    bind_steady(module);
    module.def("contact_models", &study::contact_models, "Force models without a cutting law.");
    module.def("resting_force_n", &study::resting_force_n, py::arg("model"), py::arg("depth_mm"),
               py::call_guard<py::gil_scoped_release>(),
               "The force that such a model feels of a 5 mm burr that rests so deep in flat bone of 0.1 mm "
               "voxels, N.");
}

}  // namespace osteomill::python
