// Stability: a point of the map beside the truth in continuous time, a site where bone ends, a hand on rails,
// a burr that enters bone.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <glm/geometric.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "devices/simulated/hand_and_arm.h"
#include "python/module/arrays.h"
#include "python/studies_module/bindings.h"
#include "studies/stability/map/map_run.h"
#include "studies/stability/onset/onset_run.h"
#include "studies/stability/rails/motion_on_rails.h"
#include "studies/stability/sites/named_sites.h"
#include "studies/stability/sites/site.h"
#include "studies/stability/sites/site_run.h"
#include "studies/stability/sites/site_verdict.h"

namespace osteomill::python {

namespace {

using study::MapCase;
using study::MapGrip;
using study::MapOutcome;
using study::Site;

MapGrip map_grip_of(const std::string& name) {
    if (name == "bare-arm") return MapGrip::bare_arm;
    if (name == "light") return MapGrip::light;
    if (name == "firm") return MapGrip::firm;
    throw std::invalid_argument("grip: takes bare-arm, light or firm, not " + name);
}

study::MapScene map_scene_of(const std::string& name) {
    if (name == "cutting") return study::MapScene::cutting;
    if (name == "wall") return study::MapScene::wall;
    throw std::invalid_argument("scene: takes cutting or wall, not " + name);
}

MapCase map_case(const std::string& method, const std::string& scene, const std::string& grip,
                 double milling_rate_hz, int delay_ticks, bool is_ideal_device, double spindle_rpm,
                 double depth_mm, double relative_stiffness, double edge_n_per_mm, double wall_n_per_mm,
                 bool feed_forward) {
    return {.method = method,
            .scene = map_scene_of(scene),
            .grip = map_grip_of(grip),
            .milling_rate_hz = milling_rate_hz,
            .delay_ticks = delay_ticks,
            .feed_forward = feed_forward,
            .is_ideal_device = is_ideal_device,
            .spindle_rpm = spindle_rpm,
            .depth_mm = depth_mm,
            .relative_stiffness = relative_stiffness,
            .edge_n_per_mm = edge_n_per_mm,
            .wall_n_per_mm = wall_n_per_mm};
}

py::dict dict_of(const MapOutcome& outcome) {
    using py::literals::operator""_a;
    return py::dict("is_stable"_a = outcome.is_stable,
                    "resistance_n_s_per_m"_a = outcome.resistance_n_s_per_m,
                    "truth_mean_n"_a = outcome.truth_mean_n, "limit_cycle_n"_a = outcome.limit_cycle_n,
                    "injected_mj"_a = outcome.injected_mj, "rms_error_n"_a = outcome.rms_error_n,
                    "mean_error_n"_a = outcome.mean_error_n, "peak_n"_a = outcome.peak_n,
                    "largest_jump_n"_a = outcome.largest_jump_n, "depth_error_mm"_a = outcome.depth_error_mm,
                    "removed_mm3"_a = outcome.removed_mm3, "max_residual_n"_a = outcome.max_residual_n,
                    "fallbacks"_a = outcome.fallbacks, "energy_faults"_a = outcome.energy_faults);
}

void bind_map(py::module_& module) {
    py::class_<study::SceneCache>(module, "SceneCache", "Bones and truths that points of the map share.")
        .def(py::init<>());
    module.def(
        "run_map_case",
        [](study::SceneCache& cache, const std::string& method, const std::string& scene,
           const std::string& grip, double milling_rate_hz, int delay_ticks, bool is_ideal_device,
           double spindle_rpm, double depth_mm, double relative_stiffness, double edge_n_per_mm,
           double wall_n_per_mm, bool feed_forward) {
            const MapCase c =
                map_case(method, scene, grip, milling_rate_hz, delay_ticks, is_ideal_device, spindle_rpm,
                         depth_mm, relative_stiffness, edge_n_per_mm, wall_n_per_mm, feed_forward);
            MapOutcome outcome;
            {
                const py::gil_scoped_release released;
                outcome = study::run_map_case(c, cache);
            }
            return dict_of(outcome);
        },
        py::arg("cache"), py::kw_only(), py::arg("method"), py::arg("scene"), py::arg("grip"),
        py::arg("milling_rate_hz"), py::arg("delay_ticks"), py::arg("is_ideal_device"),
        py::arg("spindle_rpm"), py::arg("depth_mm"), py::arg("relative_stiffness"), py::arg("edge_n_per_mm"),
        py::arg("wall_n_per_mm"), py::arg("feed_forward") = false,
        "Runs a point of the stability map, beside the truth in continuous time: what studies/stability/map "
        "says of its outcome.");
    module.def("coupling_tick_us", &study::coupling_tick_us, py::arg("method"), py::arg("ticks"),
               py::call_guard<py::gil_scoped_release>(),
               "Microseconds of each tick of a hand that leads a burr along a slot.");
}

py::dict dict_of(const study::SiteRun& run) {
    using py::literals::operator""_a;
    study::SiteVerdict verdict;
    {
        const py::gil_scoped_release released;
        verdict = study::verdict_on(run);
    }
    return py::dict("energy_over_rigid_mj"_a = verdict.energy_over_rigid_mj,
                    "energy_mj"_a = verdict.energy_mj, "stuck_ms"_a = verdict.stuck_ms,
                    "error_percent"_a = verdict.error_percent,
                    "error_while_driven_percent"_a = verdict.error_while_driven_percent,
                    "largest_jump_n"_a = verdict.largest_jump_n, "peak_n"_a = verdict.peak_n,
                    "noise_n"_a = verdict.noise_n, "max_residual_n"_a = run.solve.max_residual_n,
                    "fallbacks"_a = run.solve.fallbacks, "relaxed"_a = run.solve.relaxed,
                    "damped"_a = run.solve.damped, "faults"_a = run.faults);
}

/// A line for each tick: hand, burr, forces of hand, model and rigid burr, whether the spindle turns.
py::array_t<double> trace_of(const study::SiteRun& run) {
    std::vector<double> values;
    for (const study::SiteTick& tick : run.ticks) {
        for (const glm::dvec3& v : {tick.hand_mm, tick.burr_mm, tick.force_n, tick.model_n, tick.rigid_n})
            values.insert(values.end(), {v.x, v.y, v.z});
        values.push_back(tick.spindle_on ? 1.0 : 0.0);
    }
    return array_of(std::move(values), {static_cast<py::ssize_t>(run.ticks.size()), 16});
}

void bind_sites(py::module_& module) {
    py::class_<Site>(module, "Site", "A site where bone ends, and the motion of a hand there.")
        .def_readonly("kind", &Site::kind)
        .def_readonly("name", &Site::name, "Without the burr.")
        .def_readonly("burr", &Site::burr)
        .def(
            "with_edges",
            [](Site site, const py::handle& edges) {
                site.burr.edge_coefficients_n_per_mm = python::vector_of(edges, "edge_coefficients_n_per_mm");
                return site;
            },
            py::arg("edge_coefficients_n_per_mm"), "The same with a burr whose edges rub.");
    module.def("named_sites", &study::named_sites, py::arg("burr"), "Each site for one burr.");
    module.def("tilts_in_holes", &study::tilts_in_holes, "A 2 mm burr with a shank, tilted in holes.");
    module.def("random_walk", &study::random_walk, py::arg("seed"), py::arg("number"),
               "A random walk of a hand over bone, the same on every machine.");
    module.def(
        "run_site",
        [](const Site& site, const std::string& method, const std::string& grip, bool is_ideal_device,
           int delay_ticks, bool feed_forward) {
            if (grip != "firm" && grip != "light")
                throw std::invalid_argument("grip: takes firm or light, not " + grip);
            study::SiteRun run;
            {
                const py::gil_scoped_release released;
                run = study::run_site(site, {.method = method,
                                             .feed_forward = feed_forward,
                                             .grip = grip == "firm" ? Grip::firm : Grip::light,
                                             .is_ideal_device = is_ideal_device,
                                             .delay_ticks = delay_ticks});
            }
            return py::make_tuple(dict_of(run), trace_of(run));
        },
        py::arg("site"), py::kw_only(), py::arg("method"), py::arg("grip"), py::arg("is_ideal_device"),
        py::arg("delay_ticks"), py::arg("feed_forward") = false,
        "What a hand would not forgive, in numbers (studies/stability/sites/site_verdict.h), solves and "
        "faults; "
        "and each millisecond: positions of hand and burr, forces on the hand, of the model and of a rigid "
        "burr, whether the spindle turns: (n, 16).");
}

void bind_rails(py::module_& module) {
    module.def("motions_on_rails", &study::motions_on_rails, py::arg("count"), py::arg("seed"),
               py::call_guard<py::gil_scoped_release>(),
               "Random steady motions along surfaces; the same for the same seed on every machine.");
    module.def(
        "run_on_rails",
        [](const study::SteadyCase& motion, const std::string& method, bool feed_forward) {
            study::OnRails run;
            {
                const py::gil_scoped_release released;
                run = study::run_on_rails(motion, method, feed_forward);
            }
            return py::make_tuple(array_of(run.hand_n), array_of(run.model_n), run.is_driven);
        },
        py::arg("motion"), py::arg("method"), py::arg("feed_forward") = false,
        "Mean force on a hand that is led along the motion, and of the model, N: (3,) each; and whether bone "
        "pulled the burr away from the hand, so that it was no steady motion.");
}

void bind_onset(py::module_& module) {
    module.def(
        "run_onset",
        [](const Burr& burr, bool is_entry, const py::handle& up, double way_mm, double speed_mm_per_s,
           const std::string& method, double stiffness_n_per_mm, double damping_n_s_per_mm, bool is_guided,
           bool feed_forward) {
            const study::Onset onset{.burr = burr,
                                     .kind = is_entry ? study::OnsetKind::entry : study::OnsetKind::plunge,
                                     .up = glm::normalize(python::vector_of(up, "up")),
                                     .way_mm = way_mm,
                                     .speed_mm_per_s = speed_mm_per_s};
            const study::OnsetHand hand{.coupling = method,
                                        .feed_forward = feed_forward,
                                        .stiffness_n_per_mm = stiffness_n_per_mm,
                                        .damping_n_s_per_mm = damping_n_s_per_mm,
                                        .is_guided = is_guided};
            study::OnsetRun run;
            {
                const py::gil_scoped_release released;
                run = study::run_onset(onset, hand);
            }
            const double exact_n = study::peak_of(run.exact_n, 0.0).peak_n;
            py::dict found;
            std::vector<double> values(9 * run.exact_n.size());
            std::size_t column = 0;
            for (const auto& [name, forces_n] :
                 {std::pair("exact", &run.exact_n), std::pair("ideal", &run.ideal_n),
                  std::pair("felt", &run.felt_n)}) {
                const study::OnsetPeak peak = study::peak_of(*forces_n, exact_n);
                found[py::str(std::string(name) + "_peak_n")] = peak.peak_n;
                found[py::str(std::string(name) + "_half_ms")] = peak.half_ms;
                for (std::size_t i = 0; i < forces_n->size(); ++i)
                    for (int axis = 0; axis < 3; ++axis)
                        values[9 * i + column + static_cast<std::size_t>(axis)] = (*forces_n)[i][axis];
                column += 3;
            }
            return py::make_tuple(
                found, array_of(std::move(values), {static_cast<py::ssize_t>(run.exact_n.size()), 9}));
        },
        py::arg("burr"), py::kw_only(), py::arg("is_entry"), py::arg("up"), py::arg("way_mm"),
        py::arg("speed_mm_per_s"), py::arg("method"), py::arg("stiffness_n_per_mm"),
        py::arg("damping_n_s_per_mm"), py::arg("is_guided"), py::arg("feed_forward") = false,
        "A burr enters bone (studies/stability/onset): of the exact answer, an ideal spring and the coupling "
        "the "
        "peak of the force over 5 ms, and when it is over half of the exact peak; and each millisecond the "
        "three "
        "forces on the hand, N, patient axes: (n, 9).");
}

}  // namespace

void bind_stability(py::module_& module) {
    bind_map(module);
    bind_sites(module);
    bind_rails(module);
    bind_onset(module);
}

}  // namespace osteomill::python
