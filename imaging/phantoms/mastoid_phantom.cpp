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
#include "imaging/phantoms/temporal_bone.h"

namespace osteomill {

namespace {

namespace df = distance_field;

constexpr double saw_front_y_mm = -17.0, saw_back_y_mm = 29.0, saw_inner_x_mm = -25.0;

// Bone that mastoid cells leave around the parts that they border on, mm.
constexpr double cortex_mm = 2.2, plate_mm = 0.9, capsule_mm = 1.3, nerve_wall_mm = 0.9;

class TemporalBone {
  public:
    struct Near {
        std::vector<const AnatomyPart*> parts;
        std::vector<AirCell> cells;
    };

    std::optional<Near> near(const glm::dvec3& centre, double reach_mm) const {
        constexpr double slope = 1.3, sheet_mm = 1.5;
        bool is_empty = outer_mm(centre) > slope * reach_mm + sheet_mm;
        Near near;
        for (const AnatomyPart& part : parts_) {
            const double distance = distance_mm(part, centre);
            if (distance < slope * reach_mm + 1.5 * capsule_mm) near.parts.push_back(&part);
            if (distance < slope * reach_mm) is_empty = false;  // vessels go on outside the bone
        }
        if (is_empty) return std::nullopt;
        if (pneumatised_mm(centre) < slope * reach_mm + sheet_mm)
            near.cells = air_cells_near(centre, reach_mm);
        return near;
    }

    double surface_mm(const glm::dvec3& p, const Near& near) const { return distances(p, near).nearest_mm(); }

    PlaceInAnatomy at(const glm::dvec3& p, const Near& near) const {
        const Distances d = distances(p, near);
        const bool is_structure = d.structure_mm < 0.0 || d.structure_mm < d.bone_mm;
        if (is_structure)
            return {d.nearest_mm(), hu_of(d.structure), air_hu, static_cast<std::uint8_t>(d.structure)};
        // The capsule of the labyrinth is the body's densest bone.
        const double capsule = std::clamp(1.5 - d.labyrinth_mm, 0.0, 1.0);
        const double hu = 1150.0 + 250.0 * smooth_noise(p / 1.4) + 900.0 * capsule;
        return {d.nearest_mm(), hu, air_hu, static_cast<std::uint8_t>(TemporalTissue::bone)};
    }

  private:
    struct Distances {
        double bone_mm = 100.0;
        double structure_mm = 100.0;
        double labyrinth_mm = 100.0;
        TemporalTissue structure = TemporalTissue::bone;
        double nearest_mm() const { return std::min(bone_mm, structure_mm); }
    };

    static double hu_of(TemporalTissue tissue) {
        switch (tissue) {
            case TemporalTissue::malleus:
            case TemporalTissue::incus:
            case TemporalTissue::stapes:
                return 1500.0;
            case TemporalTissue::tmj:
                return 180.0;
            default:
                return 200.0;  // softer in life; here just above the threshold, to exist
        }
    }

    /// Distance of the piece as a whole, with the sheet of dura on it.
    static double outer_mm(const glm::dvec3& p) {
        return std::max(std::min(temporal_body_mm(p), dura_mm(p)), saw_mm(p));
    }
    static double saw_mm(const glm::dvec3& p) {
        return std::max(std::max(saw_front_y_mm - p.y, p.y - saw_back_y_mm), saw_inner_x_mm - p.x);
    }

    Distances distances(const glm::dvec3& p, const Near& near) const {
        std::array<double, temporal_parts> of{};
        of.fill(100.0);
        Distances d;
        for (const AnatomyPart* part : near.parts) {
            double& least = of[static_cast<std::size_t>(part->kind)];
            const double distance = distance_mm(*part, p);
            least = part->blend_mm > 0.0 ? df::smooth_union(least, distance, part->blend_mm)
                                         : std::min(least, distance);
        }
        const auto part_mm = [&](TemporalPart kind) { return of[static_cast<std::size_t>(kind)]; };
        const double body = temporal_body_mm(p);
        const double drum = drum_plane_mm(p);
        const double labyrinth = part_mm(TemporalPart::labyrinth);
        const double facial = part_mm(TemporalPart::facial_nerve);
        d.labyrinth_mm = labyrinth;

        // The ear canal ends at the drum, the tympanic cavity begins there; above it is the scutum.
        const double canal = part_mm(TemporalPart::ear_canal);
        const double lumen = std::max(canal + canal_skin_mm, 0.15 - drum);
        const double wall = std::max(std::max(canal, -drum - 0.15), -lumen);
        const double behind_drum = std::max(part_mm(TemporalPart::tympanic_cavity), drum + 0.15);
        double cavity = df::smooth_union(behind_drum, part_mm(TemporalPart::attic), 0.8);
        cavity = std::max(cavity, std::max(0.9 - labyrinth, 0.3 - facial));
        cavity = std::min(cavity, std::max(part_mm(TemporalPart::oval_niche), 0.05 - labyrinth));

        const double keep_off =
            std::max(std::max(std::max(cortex_mm + body, pneumatised_mm(p)),
                              std::max(plate_mm - part_mm(TemporalPart::sinus), capsule_mm - labyrinth)),
                     std::max(nerve_wall_mm - facial, 1.3 - canal));
        if (keep_off < 1.0) cavity = std::min(cavity, std::max(air_cells_mm(p, near.cells), keep_off));
        cavity = std::min(cavity, std::min(lumen, std::max(part_mm(TemporalPart::fossa), 1.2 - canal)));

        d.bone_mm = std::max(std::max(body, -cavity), saw_mm(p));
        const auto add = [&](TemporalTissue tissue, double distance) {
            if (distance >= d.structure_mm) return;
            d.structure_mm = distance;
            d.structure = tissue;
        };
        const double outside = std::max(saw_mm(p), -100.0);
        add(TemporalTissue::sinus_and_dura,
            std::max(std::min(part_mm(TemporalPart::sinus), dura_mm(p)), outside));
        add(TemporalTissue::iac, std::max(part_mm(TemporalPart::iac), body - 0.3));
        for (const auto& [kind, tissue] : structures_of_parts) {
            const double distance = std::max(part_mm(kind), outside);
            // A nerve within the internal canal takes precedence over the canal.
            if (distance < 0.0 && d.structure == TemporalTissue::iac) d.structure_mm = distance + 0.01;
            add(tissue, distance);
        }
        add(TemporalTissue::ear_canal, std::max(wall, body - 0.4));
        return d;
    }

    std::vector<AnatomyPart> parts_ = temporal_bone_parts();
};

}  // namespace

HuSlices make_mastoid_phantom() {
    return slices_of_anatomy(
        {.size_voxels = {320, 320, 310}, .spacing_mm = 0.15, .origin_mm = {-25.5, -17.5, -29.5}},
        TemporalBone());
}

}  // namespace osteomill
