#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>
#include <vector>

#include "imaging/phantoms/anatomy_slices.h"
#include "imaging/phantoms/distance_fields.h"
#include "imaging/phantoms/noise.h"
#include "imaging/phantoms/phantom.h"
#include "imaging/phantoms/tooth_shape.h"

namespace osteomill {

namespace {

namespace df = distance_field;

constexpr double gap_mm =
    0.32;  // periodontal: 0.15 to 0.38 in life; two voxels where the measure is steepest
constexpr double front_y_mm = -28.0, back_y_mm = 18.0;  // where the piece is sawn off
constexpr double crest_below_cervix_mm = 1.7;
constexpr double lower_border_z_mm = -29.0;
constexpr std::size_t drilled_tooth = 3;  // the first molar

/// The arch: the row's x at a place between front and back, and how it leans there.
double row_x_mm(double y) {
    return 0.12 * y - 0.006 * y * y;
}
double row_slope(double y) {
    return 0.12 - 0.012 * y;
}

struct PlacedTooth {
    ToothShape shape;
    glm::dvec3 cervix_mm{0.0};
    double along_x = 0.0, along_y = 1.0;  ///< unit, along the row to the back
    double lean = 0.0;                    ///< of the crown to the tongue, mm a mm
    static constexpr double tilt = 0.05;  ///< of the crown to the front

    glm::dvec3 middle_mm() const { return cervix_mm + glm::dvec3(0.0, 0.0, 0.25 * (shape.crown_mm - 16.0)); }
    glm::dvec3 own(const glm::dvec3& p) const {
        const glm::dvec3 d = p - cervix_mm;
        return {along_x * d.x + along_y * d.y + tilt * d.z, along_y * d.x - along_x * d.y + lean * d.z, d.z};
    }
};

/// Crowns touch. The chewing surfaces form one line, with cervices where crowns end below it.
std::vector<PlacedTooth> placed_teeth() {
    constexpr std::array cervix_z_mm{-1.8, -0.4, 0.0, 0.0, 0.5};
    constexpr std::array lean{-0.04, 0.02, 0.06, 0.1, 0.12};
    constexpr double first_y_mm = -22.3;
    std::vector<PlacedTooth> teeth;
    double y = first_y_mm;
    for (const ToothShape& shape : lower_left_teeth()) {
        const auto i = teeth.size();
        const auto length = [&] { return std::sqrt(1.0 + df::squared(row_slope(y))); };
        if (i > 0) y += 0.5 * (teeth.back().shape.crown_width_mm + shape.crown_width_mm + 0.1) / length();
        teeth.push_back(
            {shape, {row_x_mm(y), y, cervix_z_mm[i]}, row_slope(y) / length(), 1.0 / length(), lean[i]});
    }
    return teeth;
}

/// Enlarged towards the back, as the body of a jaw is under its molars. Its height, the place of its canal
/// and the thickness of its cortical bone are those at the first molar of twenty dry mandibles (Korean Acad
/// Oral Maxillofac Radiol 1997, 27:217): the canal 16.9 mm under the crest, 8.8 above the lower border, 6.6
/// from the cheek and 4.1 from the tongue; cortical bone of 2.2 and 2.0 mm. Its canal is 2.6 mm wide (Thao et
/// al. 2024, J Orthod Sci 13:45).
class Jaw {
  public:
    struct Near {
        std::array<std::size_t, 5> teeth{};
        std::size_t count = 0;
    };

    Jaw() : teeth_(placed_teeth()) {}

    std::optional<Near> near(const glm::dvec3& centre, double reach_mm) const {
        // Measures slope by so much at most; gum follows teeth within this distance, and in bone the lining
        // of their sockets does.
        constexpr double slope = 1.4, gum_reach_mm = 3.5, lining_reach_mm = 0.8;
        const double reached_mm = slope * reach_mm + (centre.z > -4.0 ? gum_reach_mm : lining_reach_mm);
        Near near;
        double nearest_tooth_mm = 100.0;
        for (std::size_t i = 0; i < teeth_.size(); ++i) {
            if (glm::distance(centre, teeth_[i].middle_mm()) > 15.5 + reached_mm) continue;
            const double distance = tooth_distance_mm(teeth_[i].shape, teeth_[i].own(centre));
            if (distance < reached_mm) near.teeth[near.count++] = i;
            nearest_tooth_mm = std::min(nearest_tooth_mm, distance);
        }
        const Section at = section_at(centre.y);
        const bool is_off_jaw = std::max(outside_mm(centre, at), at.ends_mm) > slope * reach_mm + 1.5;
        if (is_off_jaw && nearest_tooth_mm > slope * reach_mm + 0.2) return std::nullopt;
        return near;
    }

    double surface_mm(const glm::dvec3& p, const Near& near) const { return parts(p, near).nearest_mm(); }

    PlaceInAnatomy at(const glm::dvec3& p, const Near& near) const {
        const Parts part = parts(p, near);
        const Material material = material_at(p, part);
        return {part.nearest_mm(), material.hu, part.body_mm < 0.0 ? ligament_hu : air_hu,
                static_cast<std::uint8_t>(material.tissue)};
    }

  private:
    struct Material {
        DentalTissue tissue;
        double hu;
    };
    struct Parts {
        double tooth_mm = 100.0;
        std::size_t tooth = 0;
        double outside_mm = 0.0;  ///< of the jaw without sockets, as if it went on beyond its sawn ends
        double body_mm = 0.0;     ///< likewise, sawn
        double socket_mm = 0.0;   ///< likewise, with its sockets
        double gum_mm = 0.0;
        double beside_mm = 0.0;  ///< the row of teeth, to the cheek
        double nearest_mm() const { return std::min(tooth_mm, std::min(socket_mm, gum_mm)); }
    };

    /// Values that all places at one distance from the front share.
    struct Section {
        double row_x_mm = 0.0;
        double row_length = 1.0;  ///< along the row, mm a mm of y
        double between = 0.0;     ///< 0 in the middle of a tooth to 1 between two
        double cervix_z_mm = 0.0;
        double ends_mm = 0.0;  ///< from where the piece is sawn off, positive beyond

        double beside_mm(const glm::dvec3& p) const { return (p.x - row_x_mm) / row_length; }
    };
    Section section_at(double y) const {
        Section at{.row_x_mm = row_x_mm(y),
                   .row_length = std::sqrt(1.0 + df::squared(row_slope(y))),
                   .between = 1.0,
                   .cervix_z_mm = teeth_.back().cervix_mm.z,
                   .ends_mm = std::max(front_y_mm - y, y - back_y_mm)};
        for (const PlacedTooth& tooth : teeth_)
            at.between = std::min(at.between,
                                  df::squared((y - tooth.cervix_mm.y) / (0.5 * tooth.shape.crown_width_mm)));
        for (std::size_t i = teeth_.size() - 1; i > 0; --i) {
            const glm::dvec3& a = teeth_[i - 1].cervix_mm;
            const glm::dvec3& b = teeth_[i].cervix_mm;
            if (y < b.y) at.cervix_z_mm = a.z + std::clamp((y - a.y) / (b.y - a.y), 0.0, 1.0) * (b.z - a.z);
        }
        return at;
    }

    Parts parts(const glm::dvec3& p, const Near& near) const {
        Parts part;
        for (std::size_t i = 0; i < near.count; ++i) {
            const PlacedTooth& tooth = teeth_[near.teeth[i]];
            const double distance = tooth_distance_mm(tooth.shape, tooth.own(p));
            if (distance >= part.tooth_mm) continue;
            part.tooth_mm = distance;
            part.tooth = near.teeth[i];
        }
        const Section at = section_at(p.y);
        part.outside_mm = outside_mm(p, at);
        part.body_mm = df::smooth_intersection(part.outside_mm, at.ends_mm, 0.3);
        part.socket_mm = std::max(part.body_mm, gap_mm - part.tooth_mm);
        part.beside_mm = at.beside_mm(p);
        part.gum_mm = gum_mm(p, at, part.outside_mm, part.tooth_mm);
        return part;
    }

    static double outside_mm(const glm::dvec3& p, const Section& at) {
        const double beside = at.beside_mm(p);
        const double back = std::clamp((p.y + 22.0) / 33.0, 0.0, 1.2);
        const double at_crest = 4.7 + 1.3 * back;
        const double swell = std::max(0.0, 1.0 - df::squared((p.z + 17.0) / 15.5));
        const double cheek = beside - (at_crest + (0.9 + 0.7 * back) * swell);
        const double tongue =
            -beside - (at_crest + 0.4 * swell - 1.2 * std::clamp((-18.0 - p.z) / 9.0, 0.0, 1.0));
        const double crest_z = at.cervix_z_mm - crest_below_cervix_mm + 0.8 * at.between;
        const double sides = df::smooth_intersection(cheek, tongue, 2.0);
        const double top = df::smooth_intersection(sides, p.z - crest_z, 1.6);
        const double body = df::smooth_intersection(top, lower_border_z_mm - p.z, 7.0);
        return std::abs(body) > 0.7 ? body : body + 0.12 * smooth_noise(p / 2.3);
    }

    /// Follows jaw and necks at 1.1 mm, up to its margin with the papillae between teeth, and is cut off
    /// under the attached part. It overlaps the parts under it, so that there is no crack between.
    static double gum_mm(const glm::dvec3& p, const Section& at, double outside, double tooth) {
        constexpr double overlap_mm = 0.3, lower_edge_mm = 10.0, far_mm = 1.5;
        const double above_cervix = p.z - at.cervix_z_mm;
        const double overlap = -outside - overlap_mm;
        if (overlap > 0.0 || above_cervix > 6.0 || above_cervix < -14.0)
            return overlap > 0.0 ? overlap : far_mm;
        const double margin_mm = 0.9 + 2.6 * at.between;
        // Thinner towards the margin.
        const double thickness_mm = 0.35 + 0.8 * std::clamp((margin_mm - above_cervix) / 3.0, 0.0, 1.0);
        const double smooth_skin = df::smooth_union(outside, tooth, 2.2) - thickness_mm;
        if (smooth_skin > far_mm) return smooth_skin;
        const double skin = smooth_skin - 0.06 * smooth_noise(p / 0.9);
        const double top = df::smooth_intersection(skin, above_cervix - margin_mm, 0.7);
        const double edge = -lower_edge_mm + 0.9 * smooth_noise(p / 4.0) - above_cervix;
        const double gum = df::smooth_intersection(df::smooth_intersection(top, edge, 1.0), at.ends_mm, 0.3);
        return std::max(gum, overlap);
    }

    static double canal_mm(const glm::dvec3& p, double beside_row_mm) {
        const double beside = beside_row_mm + 1.0 + 0.055 * p.y;
        const double above = p.z + 19.8 - 0.12 * p.y;
        const double radius_mm = std::clamp(1.3 + 0.035 * (p.y + 9.0), 0.8, 1.3);
        return std::sqrt(beside * beside + above * above) - radius_mm;
    }

    /// Opens in the central fossa, widens where dentine begins, and points to the pulp.
    static double lesion_mm(const glm::dvec3& p) {
        const double mouth = df::ellipsoid(p - glm::dvec3(0.0, -0.1, 5.6), {1.8, 1.1, 1.5});
        const double spread = df::ellipsoid(p - glm::dvec3(0.0, -0.1, 4.1), {1.9, 1.8, 1.0});
        const double point = df::ellipsoid(p - glm::dvec3(0.1, -0.1, 3.4), {1.0, 1.0, 1.0});
        return df::smooth_union(df::smooth_union(mouth, spread, 0.8), point, 0.8) +
               0.3 * smooth_noise(p / 0.8) + 0.12 * smooth_noise(p / 0.35);
    }

    Material material_at(const glm::dvec3& p, const Parts& part) const {
        // The gum's thin margin is all gum.
        constexpr double edge_mm = 0.1;
        const bool is_off_gum = part.gum_mm >= edge_mm;
        if (part.tooth_mm < 0.0 ||
            (part.socket_mm >= 0.0 && is_off_gum && part.tooth_mm <= part.nearest_mm()))
            return material_of_tooth(p, part);
        if (part.socket_mm < 0.0 || (is_off_gum && part.socket_mm <= part.gum_mm))
            return material_of_bone(p, part);
        return {DentalTissue::gum, gum_hu};
    }

    Material material_of_tooth(const glm::dvec3& place, const Parts& part) const {
        const ToothShape& shape = teeth_[part.tooth].shape;
        const glm::dvec3 p = teeth_[part.tooth].own(place);
        if (pulp_distance_mm(shape, p) < 0.0) return {DentalTissue::pulp, pulp_hu};
        Material sound = -part.tooth_mm < enamel_thickness_mm(shape, p)
                             ? Material{DentalTissue::enamel, enamel_hu}
                             : Material{DentalTissue::dentine, dentine_hu};
        if (part.tooth != drilled_tooth || p.z < 0.0) return sound;
        // Tissue loses its mineral over 0.6 mm.
        constexpr double border_mm = 0.6;
        const double lesion = lesion_mm(p);
        const double left = std::clamp(0.5 + lesion / border_mm, 0.0, 1.0);
        sound.hu = glm::mix(lesion_hu, sound.hu, left);
        if (lesion < 0.0) return {DentalTissue::carious_lesion, std::min(sound.hu, dentine_hu)};
        return sound;
    }

    static Material material_of_bone(const glm::dvec3& p, const Parts& part) {
        constexpr double lining_mm = 0.45;  // of sockets (lamina dura) and of the canal
        const double canal = canal_mm(p, part.beside_mm);
        if (canal < 0.0) return {DentalTissue::nerve_canal, nerve_hu};
        const double thickness_mm = 2.1 + 0.9 * std::clamp((-20.0 - p.z) / 5.0, 0.0, 1.0) -
                                    0.8 * std::clamp((p.z + 6.0) / 4.0, 0.0, 1.0) +
                                    0.35 * smooth_noise(p / 1.9);
        if (-part.outside_mm < thickness_mm || part.tooth_mm < gap_mm + lining_mm || canal < lining_mm)
            return {DentalTissue::cortical_bone, cortical_hu};
        // Plates and struts among marrow.
        const double strut = 1.0 - std::abs(smooth_noise(p / glm::dvec3(0.8, 0.8, 1.1)));
        return {DentalTissue::trabecular_bone, 170.0 + 560.0 * df::squared(strut)};
    }

    std::vector<PlacedTooth> teeth_;
};

}  // namespace

HuSlices make_jaw_phantom() {
    return slices_of_anatomy(
        {.size_voxels = {216, 376, 320}, .spacing_mm = 0.125, .origin_mm = {-16.0, -28.5, -29.6}}, Jaw());
}

}  // namespace osteomill
