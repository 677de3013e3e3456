#include "python/module/tick_columns.h"

#include <string_view>

#include "simulation/safety/fault.h"

namespace osteomill::python {

TickColumns::TickColumns(const LoadedCase& loaded, std::size_t ticks)
    : removed_mm3(loaded.labels().size()), distance_mm(loaded.structures().size()), loaded_(loaded) {
    for (std::vector<double>* column : {&hand_mm, &burr_mm, &axis, &force_n, &torque_nmm, &milling_force_n})
        column->reserve(3 * ticks);
    for (std::vector<double>* column : {&time_s, &depth_mm, &spindle_torque_nmm, &removed_in_all_mm3})
        column->reserve(ticks);
    for (std::vector<std::uint8_t>* column : {&spindle_on, &fault}) column->reserve(ticks);
    for (std::vector<double>& column : removed_mm3) column.reserve(ticks);
    for (std::vector<double>& column : distance_mm) column.reserve(ticks);
}

void TickColumns::add(const SteppedSession& session) {
    const ToolState& tool = session.tool();
    time_s.push_back(tool.time_s);
    push(hand_mm, tool.hand_position_mm);
    push(burr_mm, tool.burr_position_mm);
    push(axis, tool.spindle_axis);
    push(force_n, tool.force_n);
    push(torque_nmm, tool.shank_torque_n_mm.value_or(glm::dvec3(0.0)));
    push(milling_force_n, session.milling_force_n());
    depth_mm.push_back(tool.depth_mm.value_or(0.0));
    spindle_torque_nmm.push_back(session.spindle_torque_n_mm());
    spindle_on.push_back(tool.spindle_on ? 1 : 0);
    fault.push_back(fault_number(tool));
    removed_in_all_mm3.push_back(session.removed_in_all_mm3());
    for (std::size_t i = 0; i < removed_mm3.size(); ++i)
        removed_mm3[i].push_back(session.removed_mm3(loaded_.labels()[i].label));
    for (std::size_t i = 0; i < distance_mm.size(); ++i)
        distance_mm[i].push_back(loaded_.distance_mm(i, tool));
}

std::uint8_t fault_number(const ToolState& tool) noexcept {
    if (tool.fault.text().empty()) return 0;
    for (const Fault fault : all_faults)
        if (tool.fault.text() == std::string_view(describe(fault))) return static_cast<std::uint8_t>(fault);
    return 0;
}

}  // namespace osteomill::python
