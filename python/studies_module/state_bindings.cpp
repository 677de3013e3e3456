// The states of milling: a burr along a path through a case's bone, millisecond by millisecond.
#include <pybind11/complex.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cstddef>
#include <stdexcept>
#include <utility>
#include <vector>

#include "common/sound/burr_sound.h"
#include "python/module/arrays.h"
#include "python/module/loaded_case.h"
#include "python/studies_module/bindings.h"
#include "studies/states/milled_path.h"

namespace osteomill::python {

namespace {

using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Truths = py::array_t<bool, py::array::c_style | py::array::forcecast>;

std::vector<study::PathStep> path_of(const Doubles& positions_mm, const Doubles& axes,
                                     const Truths& spindle_on) {
    const py::ssize_t count = spindle_on.size();
    for (const Doubles* of : {&positions_mm, &axes})
        if (of->ndim() != 2 || of->shape(0) != count || of->shape(1) != 3)
            throw std::invalid_argument(
                "a path has a position (n, 3), an axis (n, 3) and a spindle (n,) each millisecond");
    const auto row = [](const Doubles& of, py::ssize_t i) {
        return glm::dvec3(*of.data(i, 0), *of.data(i, 1), *of.data(i, 2));
    };
    std::vector<study::PathStep> path;
    for (py::ssize_t i = 0; i < count; ++i)
        path.push_back(
            {.pose = {row(positions_mm, i), unit(row(axes, i), "axes")}, .spindle_on = *spindle_on.data(i)});
    return path;
}

py::dict mill_path(const LoadedCase& loaded, std::size_t burr, const Doubles& positions_mm,
                   const Doubles& axes, const Truths& spindle_on) {
    const std::vector<study::PathStep> path = path_of(positions_mm, axes, spindle_on);
    study::MilledPath milled;
    {
        const py::gil_scoped_release released;
        milled = study::mill_path(loaded.settings(), loaded.scene().bone, burr, path);
    }
    const auto steps = static_cast<py::ssize_t>(path.size()) - 1;
    py::dict told;
    told["force_n"] = array_of(std::move(milled.force_n), {steps, 3});
    told["model_force_n"] = array_of(std::move(milled.model_force_n), {steps, 3});
    told["harmonic_n"] = array_of(std::move(milled.harmonic_n), {steps, milled.harmonics, 3});
    told["vibration_n"] = array_of(std::move(milled.vibration_n), {steps, 3});
    told["engaged_mm2"] = array_of(std::move(milled.engaged_mm2), {steps});
    told["relative_stiffness"] = array_of(std::move(milled.relative_stiffness), {steps});
    told["removed_mm3"] = array_of(std::move(milled.removed_mm3), {steps});
    told["normal"] = array_of(std::move(milled.normal), {steps, 3});
    told["sound"] = array_of(std::move(milled.sound), {steps * (BurrSound::rate_hz / 1000)});
    return told;
}

}  // namespace

void bind_states(py::module_& module) {
    module.attr("SOUND_HZ") = BurrSound::rate_hz;
    module.def(
        "turns", [](const Burr& burr) { return burr.sigma(); }, py::arg("burr"),
        "1: toward positive azimuth about the spindle; -1: clockwise, seen from the handpiece.");
    module.def(
        "mill_path", &mill_path, py::arg("case"), py::arg("burr"), py::arg("positions_mm"), py::arg("axes"),
        py::arg("spindle_on"),
        "A burr of the case (its number) mills the case's bone along positions (n, 3), axes (n, 3), one a "
        "millisecond; a row each step, of which there are n - 1: studies/states/milled_path.h says of what. "
        "harmonic_n (n - 1, k, 3) is complex, sound 48 samples a step.");
}

}  // namespace osteomill::python
