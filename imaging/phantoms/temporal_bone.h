// The parts of a left temporal bone, as distances, mm, negative inside.
//
// Patient axes: x lateral, y back, z up; zero in the middle of the eardrum.
//
//     facial nerve   1.4 mm wide; labyrinthine part 2.7 mm long (Fondjo et al., Afr J Neurol Sci: 2.70 +-
//     0.54),
//                    tympanic 10 to 11 and mastoid 13 to 14 mm, 8.7 mm before the sigmoid sinus (Shen et al.
//                    2017, doi 10.16066/j.1672-7002.2017.10.004: 8.66 +- 2.71)
//     canals         radii of 3.2, 3.1 and 2.3 mm, anterior, posterior and lateral (Spoor and Zonneveld 1998,
//                    Yearb Phys Anthropol 41:211)
//     ossicles       malleus 8 mm long, incus 7 mm, stapes 3.3 mm high on a footplate of 3.0 x 1.4 mm
//     (textbooks'
//                    round numbers)
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <utility>
#include <vector>

#include "imaging/phantoms/phantom.h"

namespace osteomill {

enum class TemporalPart : std::uint8_t {
    facial_nerve,
    chorda_tympani,
    superior_vestibular,
    inferior_vestibular,
    cochlear_nerve,
    iac,
    labyrinth,
    aqueduct,
    carotid,
    sinus,
    malleus,
    incus,
    stapes,
    joint,
    fossa,
    ear_canal,
    tympanic_cavity,
    attic,
    oval_niche
};
inline constexpr std::size_t temporal_parts = 19;

/// Parts that are one tissue each; where two meet, the earlier takes precedence.
inline constexpr std::array<std::pair<TemporalPart, TemporalTissue>, 12> structures_of_parts{{
    {TemporalPart::facial_nerve, TemporalTissue::facial_nerve},
    {TemporalPart::superior_vestibular, TemporalTissue::superior_vestibular_nerve},
    {TemporalPart::inferior_vestibular, TemporalTissue::inferior_vestibular_nerve},
    {TemporalPart::cochlear_nerve, TemporalTissue::cochlear_nerve},
    {TemporalPart::labyrinth, TemporalTissue::bony_labyrinth},
    {TemporalPart::aqueduct, TemporalTissue::vestibular_aqueduct},
    {TemporalPart::chorda_tympani, TemporalTissue::chorda_tympani},
    {TemporalPart::carotid, TemporalTissue::ica},
    {TemporalPart::malleus, TemporalTissue::malleus},
    {TemporalPart::incus, TemporalTissue::incus},
    {TemporalPart::stapes, TemporalTissue::stapes},
    {TemporalPart::joint, TemporalTissue::tmj},
}};

/// A piece of a part. A cone runs from `a_mm` to `b_mm` with radii `a_radius_mm` and `b_radius_mm`; an
/// ellipsoid lies about `a_mm` with the half axes `b_mm`; a ring lies about `a_mm` around the unit axis
/// `b_mm`, `a_radius_mm` wide and as thick as a tube of `b_radius_mm`.
struct AnatomyPart {
    enum class Shape : std::uint8_t { cone, ellipsoid, ring };

    TemporalPart kind = TemporalPart::facial_nerve;
    Shape shape = Shape::cone;
    glm::dvec3 a_mm{0.0}, b_mm{0.0};
    double a_radius_mm = 0.0, b_radius_mm = 0.0;
    double blend_mm = 0.0;  ///< with its part's other pieces
};

double distance_mm(const AnatomyPart& part, const glm::dvec3& p);
std::vector<AnatomyPart> temporal_bone_parts();

/// Squama, mastoid process and petrous pyramid as if they were full.
double temporal_body_mm(const glm::dvec3& p);
/// A sheet on the bone towards the middle and the posterior fossa of the skull.
double dura_mm(const glm::dvec3& p);
/// Positive on the ear canal's side.
double drum_plane_mm(const glm::dvec3& p);
/// Region in which the mastoid has air cells.
double pneumatised_mm(const glm::dvec3& p);

/// Thickness of the ear canal's skin.
inline constexpr double canal_skin_mm = 0.5;

// The air cells of a mastoid: a honeycomb of irregular cells with thin septa, some of which have an opening.

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
