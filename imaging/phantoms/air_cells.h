// The air cells of a mastoid: a honeycomb of irregular cells with thin septa, some of which have an opening.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

namespace osteomill {

/// The middle of a cell. A cell is all that lies nearer to its middle than to every other, less half a septum
/// (Voronoi's cells of a jittered lattice).
struct AirCell {
    glm::ivec3 point{0};  ///< of the lattice; decides which septa are open
    glm::dvec3 middle_mm{0.0};
};

/// All that shape the honeycomb within `reach_mm` of a place.
std::vector<AirCell> air_cells_near(const glm::dvec3& place_mm, double reach_mm);

/// A measure of the distance from air, mm, negative in it: half the difference of the ways to the two nearest
/// middles, less half a septum. On the line between two middles it is the distance, aside it rises by half
/// to one a mm, so that septa are thicker there. `cells` are those near `p`; with fewer than two there is
/// no honeycomb, and all is 100 mm away.
double air_cells_mm(const glm::dvec3& p, const std::vector<AirCell>& cells);

}  // namespace osteomill
