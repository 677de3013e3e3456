// Real time: a client that keeps up with a session, and the priority of the haptic loop.
#include <pybind11/pybind11.h>

#include <cstdint>
#include <string>

#include "python/studies_module/bindings.h"
#include "render_client/link/bone_link.h"
#include "simulation/loop/real_time.h"

namespace osteomill::python {

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
