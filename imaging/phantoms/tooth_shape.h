// Distances of a tooth of the lower jaw: of enamel and dentine together, and of its pulp; and the thickness
// of its enamel.
//
// In a tooth's own space, mm: x away from the midline along the row (distal), y towards the cheek (buccal), z
// towards the chewing surface (occlusal), zero on the axis where enamel ends (cervix).
#pragma once

#include <glm/vec3.hpp>
#include <vector>

namespace osteomill {

/// A piece of a root or of its canal: its axis runs straight in x and z, its section is a disc of the radius
/// that is stretched along y by `half_width_mm` either way, since roots are flat.
struct RootPiece {
    glm::dvec3 from_mm{0.0}, to_mm{0.0};  ///< y is not heeded
    double from_radius_mm = 0.0, to_radius_mm = 0.0;
    double from_half_width_mm = 0.0, to_half_width_mm = 0.0;
};

/// A cone whose tip is rounded: a cusp, or a ridge between two.
struct Cusp {
    glm::dvec3 tip_mm{0.0};
    double slope_x = 0.65, slope_y = 0.65;
};

struct ToothShape {
    double crown_mm = 0.0;                                ///< height
    double crown_width_mm = 0.0, crown_depth_mm = 0.0;    ///< greatest, along x and y
    double cervix_width_mm = 0.0, cervix_depth_mm = 0.0;  ///< at z = 0
    double top_width = 0.8;                               ///< of the chewing surface, times the greatest
    double top_cheek = 0.62;                              ///< likewise, to the cheek
    double top_tongue = 0.85;                             ///< likewise, to the tongue
    double squareness = 0.0;      ///< of the crown's section: 0 an ellipse, 1 of fourth power
    double cervix_rise_mm = 1.0;  ///< of the line where enamel ends, towards the neighbours
    std::vector<Cusp> cusps;
    std::vector<double> cheek_grooves_x_mm;
    std::vector<RootPiece> roots;
    glm::dvec3 chamber_mm{0.0};       ///< centre of the pulp chamber
    glm::dvec3 chamber_half_mm{0.0};  ///< its half extents
    std::vector<RootPiece> canals;    ///< and horns
};

/// Negative inside.
double tooth_distance_mm(const ToothShape& tooth, const glm::dvec3& p);
double pulp_distance_mm(const ToothShape& tooth, const glm::dvec3& p);
/// 0 on the root, 2.2 mm under the cusps.
double enamel_thickness_mm(const ToothShape& tooth, const glm::dvec3& p);

/// The left lower teeth from canine to second molar.
///
/// Lengths and diameters of crown, root and cervix are those of the table of average sizes in Ash and Nelson,
/// Wheeler's Dental Anatomy, Physiology and Occlusion, 8th ed. 2003, table 1-1. Pulp chambers of molars lie
/// as Deutsch and Musikant measured them (J Endod 2004, 30:388): their ceiling 6.4 mm under the cusps.
std::vector<ToothShape> lower_left_teeth();

// CT numbers of the tissues of teeth and jaws.

// Enamel, dentine and pulp as measured in children's teeth (2071 to 2955, 1323 to 1899, 184 to 420 HU); the
// lesion lies well below dentine.
inline constexpr double enamel_hu = 2500.0;
inline constexpr double dentine_hu = 1600.0;
inline constexpr double pulp_hu = 300.0;
inline constexpr double lesion_hu = 650.0;
inline constexpr double cortical_hu = 1600.0;
inline constexpr double ligament_hu = 60.0;
// In life they are below the threshold of bone; here just above it, so that they exist.
inline constexpr double nerve_hu = 190.0;
inline constexpr double gum_hu = 170.0;

}  // namespace osteomill
