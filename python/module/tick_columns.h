// Columns of many ticks: the arrays of a rollout.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "python/module/stepped_session.h"

namespace osteomill::python {

/// Adds a vector to a column of vectors: three values a row.
inline void push(std::vector<double>& column, const glm::dvec3& v) {
    column.insert(column.end(), {v.x, v.y, v.z});
}

class TickColumns {
  public:
    /// For so many ticks, more or less. `loaded` outlives it.
    TickColumns(const LoadedCase& loaded, std::size_t ticks);

    /// The session's newest tick.
    void add(const SteppedSession& session);

    std::vector<double> time_s;
    // Three values a tick.
    std::vector<double> hand_mm, burr_mm, axis, force_n, torque_nmm, milling_force_n;
    std::vector<double> depth_mm, spindle_torque_nmm;
    std::vector<std::uint8_t> spindle_on, fault;
    std::vector<double> removed_in_all_mm3;
    std::vector<std::vector<double>> removed_mm3;  ///< by LoadedCase::labels()
    std::vector<std::vector<double>> distance_mm;  ///< by LoadedCase::structures()

  private:
    const LoadedCase& loaded_;
};

/// Number of the Fault that a tick reports as text; 0: none.
std::uint8_t fault_number(const ToolState& tool) noexcept;

}  // namespace osteomill::python
