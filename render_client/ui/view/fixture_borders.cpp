#include "render_client/ui/view/fixture_borders.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <utility>

#include "common/bone/structure_mask.h"
#include "common/log/log.h"
#include "render_client/volume/bone_colours.h"
#include "render_client/volume/structures/structure_surface.h"

namespace osteomill {

namespace {

constexpr double opacity = 0.3;

/// Vermilion and yellow of Okabe and Ito's palette.
glm::vec3 colour_of(FixtureKind kind) {
    return kind == FixtureKind::forbidden ? linear_from_srgb({213, 94, 0}) : linear_from_srgb({240, 228, 66});
}

/// None where a structure is too large for its distances.
StructureSurface border_of(const StructureMask& structure, double distance_mm, const glm::vec3& colour) {
    try {
        return surface_of(region_about(structure, distance_mm), colour);
    } catch (const std::exception& error) {
        log_warning("the border of a fixture is not drawn: {}", error.what());
        return {};
    }
}

bool is_about(const Fixture& fixture, const Tissue& tissue) {
    return fixture.kind != FixtureKind::guide && fixture.tissue == tissue.name;
}

}  // namespace

bool FixtureBorders::is_begun(std::size_t fixture) const {
    return std::ranges::any_of(borders_, [&](const Border& border) { return border.fixture == fixture; });
}

void FixtureBorders::begin(const SessionInfo& session, std::size_t fixture, const StructureMask& structure) {
    const Fixture& one = session.fixtures[fixture];
    borders_.push_back({.fixture = fixture,
                        .surface = std::async(std::launch::async, [structure, distance_mm = one.distance_mm,
                                                                   colour = colour_of(one.kind)] {
                            return border_of(structure, distance_mm, colour);
                        })});
}

void FixtureBorders::take_in(const SessionInfo& session, const Structure& structure) {
    for (std::size_t i = 0; i < session.fixtures.size(); ++i)
        if (is_about(session.fixtures[i], session.tissues[structure.tissue]) && !is_begun(i))
            begin(session, i, structure.mask);
}

void FixtureBorders::take_in_labels(const SessionInfo& session, const Bone& bone) {
    if (std::exchange(has_labels_, true)) return;
    for (const Tissue& tissue : session.tissues) {
        StructureMask structure;
        for (std::size_t i = 0; i < session.fixtures.size(); ++i) {
            if (!is_about(session.fixtures[i], tissue) || is_begun(i)) continue;
            if (structure.empty()) structure = structure_in_bone(bone, tissue.label);
            begin(session, i, structure);
        }
    }
}

bool FixtureBorders::show(StereoPicture& picture, FixtureSet on, bool waits) {
    bool is_another = false;
    for (Border& border : borders_) {
        const bool is_ready =
            border.surface.valid() &&
            (waits || border.surface.wait_for(std::chrono::seconds(0)) == std::future_status::ready);
        if (is_ready) {
            border.shown_as = picture.add_structure(border.surface.get(), opacity);
            is_another = true;
        }
        const bool is_on = has_fixture(on, border.fixture);
        if (!border.shown_as || std::exchange(border.is_shown, is_on) == is_on) continue;
        picture.show_structure(*border.shown_as, is_on);
        is_another = true;
    }
    return is_another;
}

void FixtureBorders::forget() {
    borders_.clear();
    has_labels_ = false;
}

}  // namespace osteomill
