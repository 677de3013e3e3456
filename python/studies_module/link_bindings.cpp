// The link: the data that cross it, the age of a client's picture, and the number of voxels in which its bone
// differs.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "python/module/arrays.h"
#include "python/module/loaded_case.h"
#include "python/studies_module/bindings.h"
#include "render_client/link/bone_link.h"
#include "simulation/loop/real_time.h"
#include "studies/link/link_run.h"

namespace osteomill::python {

namespace {

using Vector = std::array<double, 3>;

py::dict run_link(const LoadedCase& loaded, const Burr& burr, const Vector& axis, double tick_s,
                  const std::vector<Vector>& positions_mm, const std::string& content, double frame_rate_hz,
                  std::optional<double> bytes_per_s, double latency_s) {
    study::LinkChoice choice{.content = study::link_content_named(content),
                             .frame_rate_hz = frame_rate_hz,
                             .latency_s = latency_s};
    if (bytes_per_s) choice.bytes_per_s = *bytes_per_s;
    std::vector<glm::dvec3> positions;
    for (const Vector& at : positions_mm) positions.emplace_back(at[0], at[1], at[2]);
    study::LinkOutcome found;
    {
        const py::gil_scoped_release released;
        found = study::run_link(loaded.scene().bone, burr, {axis[0], axis[1], axis[2]}, tick_s, positions,
                                choice);
    }
    py::dict told;
    told["bytes_per_s"] = found.bytes_per_s;
    told["most_bytes_in_a_second"] = found.most_bytes_in_a_second;
    told["delay_mean_ms"] = found.delay_mean_ms;
    told["delay_p99_ms"] = found.delay_p99_ms;
    told["differing_voxels_mean"] = found.differing_voxels_mean;
    told["differing_voxels_most"] = found.differing_voxels_most;
    told["differing_voxels_left"] = found.differing_voxels_left;
    told["frame_us"] = found.frame_us;
    return told;
}

}  // namespace

void bind_links(py::module_& module) {
    module.def("run_link", &run_link, py::arg("case"), py::arg("burr"), py::arg("axis"), py::arg("tick_s"),
               py::arg("positions_mm"), py::kw_only(), py::arg("content") = "changes",
               py::arg("frame_rate_hz") = 30.0, py::arg("bytes_per_s") = py::none(),
               py::arg("latency_s") = 0.0,
               "A burr mills a case's bone along positions, each a tick after the one before, and a client "
               "follows: the program's own messages over a simulated link, which takes so many bytes a "
               "second. content: changes, bricks, poses.");
}

// Real time: a client that keeps up with a session, and the priority of the haptic loop.

namespace py = pybind11;

void bind_real_time(py::module_& module) {
    module.attr("HAPTIC_PRIORITY") = haptic_priority;
    py::class_<BoneLink>(module, "Client", "A client of a server, which follows the bone and draws nothing.")
        .def(py::init<std::string, std::uint16_t>(), py::arg("host"), py::arg("port"))
        .def(
            "frames", [](BoneLink& link) { return link.poll().frames; },
            py::call_guard<py::gil_scoped_release>(), "Applies what has come: how many frames there were.");
}

}  // namespace osteomill::python
