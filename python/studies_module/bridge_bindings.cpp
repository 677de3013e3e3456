// The bridge: round trips to an arm in another process, beside a bare echo.
#include <fmt/format.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <unistd.h>

#include <optional>
#include <stdexcept>
#include <string>

#include "python/studies_module/bindings.h"
#include "studies/bridge/private_network.h"
#include "studies/bridge/round_trips.h"

namespace osteomill::python {

namespace py = pybind11;

namespace {

constexpr std::uint16_t port = 17020;

study::RoundTrips trips_over(const std::string& over, bool has_key, double seconds) {
    if (over == "unix")
        return study::measure_round_trips(
            {.where = BridgePath{fmt::format("/tmp/osteomill_study_{}", getpid())}, .has_key = has_key},
            seconds);
    if (over == "udp")
        return study::measure_round_trips({.where = ListenAddress{.port = port}, .has_key = has_key},
                                          seconds);
    if (over != "namespaces") throw std::invalid_argument("over: takes unix, udp or namespaces, not " + over);
    const study::PrivateNetwork network;
    return study::measure_round_trips(
        {.where = ListenAddress{.address = study::PrivateNetwork::server_address, .port = port},
         .server_namespace = network.server(),
         .arm_namespace = network.client(),
         .has_key = has_key},
        seconds);
}

}  // namespace

void bind_bridge(py::module_& module) {
    module.def("why_no_namespaces", &study::PrivateNetwork::why_not, py::call_guard<py::gil_scoped_release>(),
               "Why two network namespaces cannot be made here; empty where they can.");
    module.def(
        "round_trips_us",
        [](const std::string& over, bool has_key, double seconds) {
            study::RoundTrips trips;
            {
                const py::gil_scoped_release released;
                trips = with_printable_error([&] { return trips_over(over, has_key, seconds); });
            }
            return py::make_tuple(trips.bridge_us, trips.echo_us);
        },
        py::arg("over"), py::kw_only(), py::arg("has_key"), py::arg("seconds"),
        "Over a socket (unix, udp, or udp between two namespaces), in turns: microseconds from an arm's pose "
        "to "
        "the force that answers it, and of a datagram of the same size that comes back as it is.");
}

}  // namespace osteomill::python
