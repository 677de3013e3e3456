#include "imaging/phantoms/air_cells.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "imaging/phantoms/distance_fields.h"
#include "imaging/phantoms/noise.h"

namespace osteomill {

namespace {

namespace df = distance_field;

constexpr double lattice_mm = 3.0, jitter = 0.36;  // the second as a share of the first
constexpr double septum_mm = 0.32, corner_mm = 0.3;
// Cells communicate: a third of the septa has a round opening.
constexpr double opening_radius_mm = 0.55, open_share = 1.0 / 3.0;
// A cell whose middle is further from a place takes no part in its corners.
constexpr double neighbour_mm = 4.5;

AirCell cell_at(const glm::ivec3& point) {
    const auto noise = [&](int channel) { return lattice_noise(point + glm::ivec3(1000 * channel, 0, 0)); };
    return {point, lattice_mm * (glm::dvec3(point) + jitter * glm::dvec3(noise(0), noise(1), noise(2)))};
}

/// The same from either side.
bool is_open(const AirCell& one, const AirCell& other) {
    return lattice_noise(one.point + other.point + glm::ivec3(-2000, 0, 0)) < 2.0 * open_share - 1.0;
}

}  // namespace

std::vector<AirCell> air_cells_near(const glm::dvec3& place_mm, double reach_mm) {
    const double within_mm = reach_mm + neighbour_mm;
    const int steps = static_cast<int>(std::ceil(within_mm / lattice_mm + jitter));
    const glm::ivec3 middle(glm::floor(place_mm / lattice_mm + 0.5));
    std::vector<AirCell> cells;
    glm::ivec3 step;
    for (step.z = -steps; step.z <= steps; ++step.z)
        for (step.y = -steps; step.y <= steps; ++step.y)
            for (step.x = -steps; step.x <= steps; ++step.x)
                if (const AirCell cell = cell_at(middle + step);
                    glm::distance(cell.middle_mm, place_mm) < within_mm)
                    cells.push_back(cell);
    return cells;
}

double air_cells_mm(const glm::dvec3& p, const std::vector<AirCell>& cells) {
    if (cells.size() < 2) return 100.0;
    const auto away_mm = [&](const AirCell& cell) { return glm::distance(p, cell.middle_mm); };
    const AirCell& own = *std::ranges::min_element(cells, {}, away_mm);
    const double own_mm = away_mm(own);
    // By the two septa that matter most, in whichever order they come.
    double first_mm = -100.0, second_mm = -100.0;
    for (const AirCell& other : cells) {
        if (&other == &own) continue;
        double septum_at_mm = 0.5 * (septum_mm - away_mm(other) + own_mm);
        if (septum_at_mm < second_mm) continue;
        if (is_open(own, other)) {
            const glm::dvec3 way = glm::normalize(other.middle_mm - own.middle_mm);
            const double aside_mm = glm::length(glm::cross(p - own.middle_mm, way));
            septum_at_mm = std::min(septum_at_mm, aside_mm - opening_radius_mm);
        }
        second_mm = std::max(second_mm, std::min(first_mm, septum_at_mm));
        first_mm = std::max(first_mm, septum_at_mm);
    }
    return df::smooth_intersection(first_mm, second_mm, corner_mm);
}

}  // namespace osteomill
