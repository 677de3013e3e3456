// Ticks of a session in Python: a tick is a Step, several are a dict of arrays.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <vector>

#include "python/module/stepped_session.h"
#include "python/module/tick_columns.h"

namespace osteomill::python {

/// Result of a step: the values of its last tick. It needs no case, and can be sent to other processes.
struct Tick {
    TickState state{};
    std::shared_ptr<const StepNames> names{};
    std::vector<double> distance_mm{};  ///< by the structures' names

    Tick() = default;
    Tick(TickState known, const LoadedCase& loaded);
};

void bind_tick(pybind11::module_& module);

/// Takes the columns over.
pybind11::dict dict_of(TickColumns&& columns, const LoadedCase& loaded);

}  // namespace osteomill::python
