// A session's state in Python: the motion that led there.
#include <fmt/format.h>
#include <pybind11/pybind11.h>

#include <cstring>
#include <numeric>
#include <string>
#include <vector>

#include "python/module/bindings.h"
#include "python/module/stepped_session.h"

namespace osteomill::python {

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
